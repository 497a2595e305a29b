#include "alea/checkerboard/board_plane.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "alea/cloud/spatial_order.hpp"
#include "alea/core/seed.hpp"

namespace alea {
namespace {

constexpr std::array<double, 5> slabs{0.003, 0.008, 0.02, 0.06, 0.15};  // of the side

/// Log-likelihood of points in a slab of this half thickness and the rest anywhere in the crop,
/// over that of all anywhere.
double slab_gain(std::size_t inside, std::size_t all, double half_thickness, double crop_radius) {
  const double n = static_cast<double>(all), k = static_cast<double>(inside);
  if (inside == 0) return 0;
  const double share = k / n, volume = half_thickness / crop_radius;
  double gain = k * std::log(share / volume);
  if (inside < all) gain += (n - k) * std::log((1 - share) / std::max(1 - volume, 1e-6));
  return gain;
}

struct Slab {
  Plane plane;
  double half_thickness = 0, gain = 0;
};

void improve(const Plane& plane, const std::vector<Eigen::Vector3d>& sample, double side_m,
             double radius, Slab& best) {
  std::array<std::size_t, slabs.size()> counts{};
  for (const Eigen::Vector3d& p : sample) {
    const double off = std::abs(plane.signed_distance(p)) / side_m;
    for (std::size_t k = 0; k < slabs.size(); ++k) counts[k] += off <= slabs[k];
  }
  for (std::size_t k = 0; k < slabs.size(); ++k) {
    const double gain = slab_gain(counts[k], sample.size(), slabs[k] * side_m, radius);
    if (counts[k] >= 8 && gain > best.gain) best = {plane, slabs[k] * side_m, gain};
  }
}

/// Principal components of the sample points within 1.5 half thicknesses.
Plane refitted(const Slab& slab, const std::vector<Eigen::Vector3d>& sample) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double n = 0;
  for (const Eigen::Vector3d& p : sample) {
    if (std::abs(slab.plane.signed_distance(p)) > 1.5 * slab.half_thickness) continue;
    sum += p;
    squares += p * p.transpose();
    ++n;
  }
  const Eigen::Vector3d mean = sum / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / n -
                                                              mean * mean.transpose());
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return {normal, normal.dot(mean)};
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
  double along(std::size_t i) const {
    return plane_.plane.signed_distance(points_.positions[i]) / cosine(i);
  }
  Eigen::Vector2d place(std::size_t i) const {
    const Eigen::Vector3d& ray = points_.rays.empty() ? plane_.plane.normal : points_.rays[i];
    return plane_.axes.transpose() * (points_.positions[i] - along(i) * ray - plane_.anchor);
  }

 private:
  const BoardPoints& points_;
  const BoardPlane& plane_;
};

/// Robust scale of each class: 1.4826 times the median of |residual|.
void update_scales(const RayResiduals& residuals, const std::vector<std::uint8_t>& is_light,
                   BoardPlane& plane) {
  std::array<std::vector<double>, 2> sizes;
  for (std::size_t i = 0; i < is_light.size(); ++i)
    sizes[is_light[i]].push_back(std::abs(residuals.along(i)));
  std::array<double, 2> scale{};
  for (int c = 0; c < 2; ++c)
    scale[c] = sizes[c].size() < 6 ? 0 : std::max(1.4826 * median(sizes[c]), 1e-7);
  for (int c = 0; c < 2; ++c)  // a class with too few points takes the other's
    plane.range_sd_m[c] = scale[c] > 0 ? scale[c] : std::max(scale[1 - c], 1e-7);
}

struct PlaneSums {
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();     ///< sum psi' J J'
  Eigen::Matrix3d weighted = Eigen::Matrix3d::Zero();  ///< sum w J J'
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();   ///< sum psi^2 J J'
  Eigen::Matrix3d fisher = Eigen::Matrix3d::Zero();    ///< sum J J' / sd^2
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0, weights = 0;
};

PlaneSums plane_sums(const RayResiduals& residuals, const std::vector<std::uint8_t>& is_light,
                     const BoardPlane& plane) {
  constexpr double tukey = 4.685;
  PlaneSums sums;
  for (std::size_t i = 0; i < is_light.size(); ++i) {
    const double sd = plane.range_sd_m[is_light[i]], along = residuals.along(i);
    const double u = along / (sd * tukey);
    const Eigen::Vector2d place = residuals.place(i);
    const Eigen::Vector3d row =
        Eigen::Vector3d(place.x(), place.y(), -1) / (residuals.cosine(i) * sd);
    sums.fisher += row * row.transpose();
    if (std::abs(u) >= 1) continue;
    const double share = 1 - u * u, weight = share * share, psi = weight * along / sd;
    const Eigen::Matrix3d outer = row * row.transpose();
    sums.slope += (share * (1 - 5 * u * u)) * outer;
    sums.weighted += weight * outer;
    sums.scatter += psi * psi * outer;
    sums.right -= psi * row;
    const double off = along * residuals.cosine(i);
    sums.squares += weight * off * off;
    sums.weights += weight;
  }
  return sums;
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

std::optional<RoughPlane> find_rough_plane(const BoardPoints& points, double side_m) {
  if (points.size() < 8) return std::nullopt;
  constexpr std::size_t most = 600;
  std::vector<Eigen::Vector3d> sample;
  const double stride = std::max(1.0, static_cast<double>(points.size()) / most);
  double radius = 0;
  for (double at = 0; at < static_cast<double>(points.size()); at += stride) {
    sample.push_back(points.positions[static_cast<std::size_t>(at)]);
    radius = std::max(radius, sample.back().norm());
  }
  RandomStream stream({1, 50, 0, 0, Purpose::plane_detector});
  Slab best;
  for (int trial = 0; trial < 120; ++trial) {
    const Eigen::Vector3d& a = sample[stream.below(sample.size())];
    const Eigen::Vector3d& b = sample[stream.below(sample.size())];
    const Eigen::Vector3d& c = sample[stream.below(sample.size())];
    const Eigen::Vector3d across = (b - a).cross(c - a);
    if (across.norm() < 0.01 * side_m * side_m) continue;
    const Eigen::Vector3d normal = across.normalized();
    improve({normal, normal.dot(a)}, sample, side_m, radius, best);
  }
  if (best.gain <= 0) return std::nullopt;
  for (int round = 0; round < 4; ++round)
    improve(refitted(best, sample), sample, side_m, radius, best);
  RoughPlane rough{best.plane, best.half_thickness, {}};
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (std::abs(best.plane.signed_distance(points.positions[i])) <= 3 * best.half_thickness)
      rough.members.push_back(i);
  return rough;
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
  const RayResiduals residuals(points, plane);
  for (int round = 0; round < 5; ++round) {
    update_scales(residuals, is_light, plane);
    const PlaneSums sums = plane_sums(residuals, is_light, plane);
    turn(sums.weighted.ldlt().solve(sums.right), plane);
  }
  const PlaneSums sums = plane_sums(residuals, is_light, plane);
  const Eigen::Matrix3d inverse = sums.slope.inverse();
  plane.covariance = inverse * sums.scatter * inverse;
  plane.bound = sums.fisher.inverse();
  plane.rmse_m = sums.weights > 0 ? std::sqrt(sums.squares / sums.weights) : 0;
  return plane;
}

std::vector<Eigen::Vector2d> places_on(const BoardPlane& plane, const BoardPoints& points) {
  const RayResiduals residuals(points, plane);
  std::vector<Eigen::Vector2d> places(points.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = residuals.place(i);
  return places;
}

}  // namespace alea
