#include "alea/checkerboard/board_plane.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "alea/cloud/spatial_order.hpp"
#include "alea/core/median.hpp"

namespace alea {
namespace {

/// Distances along the ray and where the ray meets the plane.
class RayResiduals {
 public:
  RayResiduals(const BoardPoints& points, const BoardPlane& plane)
      : points_(points), plane_(plane) {}

  double cosine(std::size_t i) const {
    if (points_.rays.empty()) return 1;
    const double c = plane_.plane.normal.dot(points_.rays[i]);
    return std::copysign(std::max(std::abs(c), 0.03), c);
  }
  double along(std::size_t i, double cosine) const {
    return plane_.plane.signed_distance(points_.positions[i]) / cosine;
  }
  Eigen::Vector2d place(std::size_t i, double along_m) const {
    const Eigen::Vector3d& ray = points_.rays.empty() ? plane_.plane.normal : points_.rays[i];
    return plane_.axes.transpose() * (points_.positions[i] - along_m * ray - plane_.anchor);
  }

 private:
  const BoardPoints& points_;
  const BoardPlane& plane_;
};

struct RayResidual {
  double cosine, along_m;
};

std::vector<RayResidual> residuals_of(const RayResiduals& residuals, std::size_t points) {
  std::vector<RayResidual> all(points);
  for (std::size_t i = 0; i < points; ++i) {
    all[i].cosine = residuals.cosine(i);
    all[i].along_m = residuals.along(i, all[i].cosine);
  }
  return all;
}

/// Robust scale of each class: 1.4826 times the median of |residual|.
void update_scales(const std::vector<RayResidual>& residuals,
                   const std::vector<std::uint8_t>& is_light, BoardPlane& plane) {
  std::array<std::vector<double>, 2> sizes;
  for (auto& of_class : sizes) of_class.reserve(is_light.size());
  for (std::size_t i = 0; i < is_light.size(); ++i)
    sizes[is_light[i]].push_back(std::abs(residuals[i].along_m));
  std::array<double, 2> scale{};
  for (int c = 0; c < 2; ++c)
    scale[c] = sizes[c].size() < 6 ? 0 : std::max(1.4826 * median(std::move(sizes[c])), 1e-7);
  for (int c = 0; c < 2; ++c)  // a class with too few points takes the other's
    plane.range_sd_m[c] = scale[c] > 0 ? scale[c] : std::max(scale[1 - c], 1e-7);
}

constexpr double tukey = 4.685;

/// Normal equations of one step under Tukey's weights: sum w J J' and - sum w J r.
struct PlaneStep {
  Eigen::Matrix3d weighted = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

Eigen::Vector3d plane_row(const RayResiduals& rays, std::size_t i, const RayResidual& residual,
                          double sd) {
  const Eigen::Vector2d place = rays.place(i, residual.along_m);
  return Eigen::Vector3d(place.x(), place.y(), -1) / (residual.cosine * sd);
}

/// The upper triangle of a symmetric product a b'.
void add_upper(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Matrix3d& sum) {
  for (int column = 0; column < 3; ++column)
    for (int k = 0; k <= column; ++k) sum(k, column) += a[k] * b[column];
}

PlaneStep plane_step(const RayResiduals& rays, const std::vector<RayResidual>& residuals,
                     const std::vector<std::uint8_t>& is_light, const BoardPlane& plane) {
  PlaneStep sums;
  for (std::size_t i = 0; i < is_light.size(); ++i) {
    const double sd = plane.range_sd_m[is_light[i]], u = residuals[i].along_m / (sd * tukey);
    if (std::abs(u) >= 1) continue;
    const Eigen::Vector3d row = plane_row(rays, i, residuals[i], sd);
    const Eigen::Vector3d weighed = (1 - u * u) * (1 - u * u) * row;
    add_upper(weighed, row, sums.weighted);
    sums.right -= (residuals[i].along_m / sd) * weighed;
  }
  sums.weighted.triangularView<Eigen::StrictlyLower>() = sums.weighted.transpose();
  return sums;
}

/// Covariance, bound and scatter at the end.
void add_precision(const RayResiduals& rays, const std::vector<RayResidual>& residuals,
                   const std::vector<std::uint8_t>& is_light, BoardPlane& plane) {
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();    // sum psi' J J'
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  // sum psi^2 J J'
  Eigen::Matrix3d fisher = Eigen::Matrix3d::Zero();   // sum J J' / sd^2
  double squares = 0, weights = 0;
  for (std::size_t i = 0; i < is_light.size(); ++i) {
    const double sd = plane.range_sd_m[is_light[i]], u = residuals[i].along_m / (sd * tukey);
    const Eigen::Vector3d row = plane_row(rays, i, residuals[i], sd);
    const Eigen::Matrix3d outer = row * row.transpose();
    fisher += outer;
    if (std::abs(u) >= 1) continue;
    const double share = 1 - u * u, weight = share * share,
                 psi = weight * residuals[i].along_m / sd;
    slope += (share * (1 - 5 * u * u)) * outer;
    scatter += psi * psi * outer;
    const double off = residuals[i].along_m * residuals[i].cosine;
    squares += weight * off * off;
    weights += weight;
  }
  const Eigen::Matrix3d inverse = slope.inverse();
  plane.covariance = inverse * scatter * inverse;
  plane.bound = fisher.inverse();
  plane.rmse_m = weights > 0 ? std::sqrt(squares / weights) : 0;
}

void turn(const Eigen::Vector3d& step, BoardPlane& plane) {
  plane.plane.normal =
      (plane.plane.normal + step.x() * plane.axes.col(0) + step.y() * plane.axes.col(1))
          .normalized();
  plane.anchor += step.z() * plane.plane.normal;
  plane.plane.offset_m = plane.plane.normal.dot(plane.anchor);
  plane.axes = tangent_basis(plane.plane.normal);
}

}  // namespace

BoardPoints board_points(const Cloud& cloud, const Eigen::Vector3d& near_m, double radius_m,
                         const std::optional<Eigen::Vector3d>& scanner_position) {
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if ((cloud.positions[i] - near_m).squaredNorm() <= radius_m * radius_m) inside.push_back(i);
  const Cloud crop = subset(cloud, inside);
  BoardPoints points;
  points.origin = near_m;
  for (const std::uint32_t i : spatial_order(crop)) {
    points.positions.push_back(crop.positions[i] - near_m);
    if (scanner_position)
      points.rays.push_back((crop.positions[i] - *scanner_position).normalized());
    points.intensity.push_back(crop.intensity[i]);
  }
  return points;
}

BoardPoints subset(const BoardPoints& points, const std::vector<std::uint32_t>& indices) {
  BoardPoints some;
  some.origin = points.origin;
  for (const std::uint32_t i : indices) {
    some.positions.push_back(points.positions[i]);
    if (!points.rays.empty()) some.rays.push_back(points.rays[i]);
    some.intensity.push_back(points.intensity[i]);
  }
  return some;
}

BoardPlane fit_board_plane(const BoardPoints& points, const std::vector<std::uint8_t>& is_light,
                           const Plane& start) {
  BoardPlane plane;
  plane.plane = start;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points.positions) mean += p;
  mean /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
  if (!points.rays.empty() && points.rays[0].dot(start.normal) > 0) plane.plane = start.flipped();
  plane.anchor = mean - plane.plane.signed_distance(mean) * plane.plane.normal;
  plane.axes = tangent_basis(plane.plane.normal);
  const RayResiduals rays(points, plane);
  std::vector<RayResidual> residuals = residuals_of(rays, points.size());
  for (int round = 0; round < 5; ++round) {
    update_scales(residuals, is_light, plane);
    const PlaneStep sums = plane_step(rays, residuals, is_light, plane);
    const Eigen::Vector3d step = sums.weighted.ldlt().solve(sums.right);
    turn(step, plane);
    residuals = residuals_of(rays, points.size());
    if (step.dot(sums.weighted * step) < 1e-6) break;  // a thousandth of a standard deviation
  }
  add_precision(rays, residuals, is_light, plane);
  return plane;
}

std::vector<Eigen::Vector2d> places_on(const BoardPlane& plane, const BoardPoints& points) {
  const RayResiduals residuals(points, plane);
  std::vector<Eigen::Vector2d> places(points.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = residuals.place(i, residuals.along(i, residuals.cosine(i)));
  return places;
}

}  // namespace alea
