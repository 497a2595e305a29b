#include "alea/facet/plane_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/core/order_free_sum.hpp"

namespace alea {
namespace {

using Points = std::span<const Eigen::Vector3d>;

constexpr double huber_limit = 1.345;   // 95 % efficiency at the normal distribution
constexpr double normal_mad = 0.67449;  // median of |standard normal|
constexpr double least_cosine = 1e-3;   // a ray nearer to the plane's direction tells nothing
constexpr int orthogonal_passes = 2, ray_passes = 4, robust_passes = 8;

/// The points relative to the middle of their bounding box, which no order of them changes.
struct Centred {
  Eigen::Vector3d origin;
  double reach_m;  // largest coordinate difference from the origin
  std::optional<Eigen::Vector3d> scanner;
};

Centred centre(Points points, const PlaneFitOptions& options) {
  if (points.size() < 3)
    throw usage_error("plane fit: " + std::to_string(points.size()) +
                      " points given; give at least three that are not on one line");
  Eigen::Vector3d low = points[0], high = points[0];
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  Centred out{low + (high - low) / 2, (high - low).maxCoeff() / 2, std::nullopt};
  if (!std::isfinite(out.reach_m) || !(out.reach_m > 0))
    throw usage_error("plane fit: the points coincide or are not finite; give distinct points");
  if (options.scanner_position) out.scanner = *options.scanner_position - out.origin;
  return out;
}

/// One pass's per-point numbers.
struct Residuals {
  std::vector<double> normal_m;  // signed distance along the normal
  std::vector<double> expected;  // variance that the noise model expects of the minimised residual
  std::vector<double> weight;    // of the squared minimised residual
  std::vector<double> cosine;    // between normal and ray; 1 for orthogonal distances
};

struct CentredPlane {
  Eigen::Vector3d point, normal;
};

Residuals residuals_at(Points points, const Centred& centred, const CentredPlane& plane,
                       const PlaneFitOptions& options) {
  const std::size_t n = points.size();
  Residuals out{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n),
                std::vector<double>(n, 1.0)};
  const double plain_sd = options.noise.normal_sd_m(0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p = points[i] - centred.origin;
    out.normal_m[i] = plane.normal.dot(p - plane.point);
    if (!centred.scanner) {
      out.expected[i] = plain_sd * plain_sd, out.weight[i] = 1;
      continue;
    }
    const Eigen::Vector3d ray = (p - *centred.scanner).normalized();
    const double cosine = -plane.normal.dot(ray);
    const double height = plane.normal.dot(*centred.scanner - plane.point);
    const double usable = std::max(cosine, least_cosine);
    const double range = height / usable;
    const double sd = options.noise.normal_sd_m(range, usable);
    const double area = range * range / usable;
    const bool along_ray = options.method == FitMethod::along_ray;
    out.expected[i] = sd * sd / (along_ray ? usable * usable : 1);
    out.cosine[i] = along_ray ? usable : 1;
    out.weight[i] = options.area_weights ? area * (along_ray ? usable * usable : 1)
                    : along_ray          ? 1 / out.expected[i]
                                         : 1;
    if (cosine < least_cosine) out.weight[i] = 0;
  }
  return out;
}

void weigh_robustly(Residuals& residuals) {
  std::vector<double> standard(residuals.normal_m.size());
  for (std::size_t i = 0; i < standard.size(); ++i)
    standard[i] =
        std::abs(residuals.normal_m[i] / residuals.cosine[i]) / std::sqrt(residuals.expected[i]);
  std::vector<double> sorted = standard;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double limit = huber_limit * std::max(*middle / normal_mad, 1e-12);
  for (std::size_t i = 0; i < standard.size(); ++i)
    if (standard[i] > limit) residuals.weight[i] *= limit / standard[i];
}

/// Weighted mean and second moments about `about`, free of order.
struct Moments {
  double weight;
  Eigen::Vector3d mean;
  Eigen::Matrix3d scatter;
};

Moments moments(Points points, const Centred& centred, const std::vector<double>& weight) {
  const double heaviest = *std::max_element(weight.begin(), weight.end());
  const double first = heaviest * centred.reach_m, second = first * centred.reach_m;
  OrderFreeSum<10> sums(
      {heaviest, first, first, first, second, second, second, second, second, second},
      points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i] - centred.origin;
    sums.add(0, weight[i]);
    std::size_t k = 4;
    for (int r = 0; r < 3; ++r) {
      sums.add(static_cast<std::size_t>(r) + 1, weight[i] * p[r]);
      for (int c = 0; c <= r; ++c) sums.add(k++, weight[i] * p[r] * p[c]);
    }
  }
  Moments out{sums.total(0), Eigen::Vector3d(sums.total(1), sums.total(2), sums.total(3)), {}};
  out.mean /= out.weight;
  std::size_t k = 4;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= r; ++c, ++k)
      out.scatter(r, c) = out.scatter(c, r) =
          sums.total(k) / out.weight - out.mean[r] * out.mean[c];
  return out;
}

CentredPlane principal_plane(const Moments& moments, const Centred& centred) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.scatter);
  if (solver.eigenvalues()[1] <= 1e-12 * solver.eigenvalues()[2])
    throw usage_error("plane fit: the points lie on one line; give points that span a surface");
  CentredPlane out{moments.mean, solver.eigenvectors().col(0)};
  const Eigen::Vector3d outside =
      centred.scanner ? *centred.scanner : Eigen::Vector3d(-centred.origin);
  if (out.normal.dot(outside - out.point) < 0) out.normal = -out.normal;
  return out;
}

/// Sums of the linearised problem in (a, b, c): J' W J, J' W e, J' W S W J.
struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
};

NormalEquations normal_equations(Points points, const Centred& centred, const CentredPlane& plane,
                                 const Residuals& residuals) {
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(plane.normal);
  const auto jacobian = [&](std::size_t i) {
    const Eigen::Vector3d p = points[i] - centred.origin;
    Eigen::Vector3d at = p - plane.point;  // along the ray: moved to where the ray meets the plane
    if (residuals.cosine[i] != 1.0)
      at += (residuals.normal_m[i] / residuals.cosine[i]) * (p - *centred.scanner).normalized();
    return Eigen::Vector3d(Eigen::Vector3d(-at.dot(tangent.col(0)), -at.dot(tangent.col(1)), 1) /
                           residuals.cosine[i]);
  };
  std::array<double, 15> bounds{};
  const auto terms = [&](std::size_t i) {
    const Eigen::Vector3d j = jacobian(i);
    const double w = residuals.weight[i], e = residuals.normal_m[i] / residuals.cosine[i];
    const double s = w * w * residuals.expected[i];
    std::array<double, 15> t{};
    std::size_t k = 0;
    for (int r = 0; r < 3; ++r) {
      t[k++] = w * j[r] * e;
      for (int c = 0; c <= r; ++c) t[k++] = w * j[r] * j[c], t[k++] = s * j[r] * j[c];
    }
    return t;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto t = terms(i);
    for (std::size_t k = 0; k < t.size(); ++k) bounds[k] = std::max(bounds[k], std::abs(t[k]));
  }
  OrderFreeSum<15> sums(bounds, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto t = terms(i);
    for (std::size_t k = 0; k < t.size(); ++k) sums.add(k, t[k]);
  }
  NormalEquations out;
  std::size_t k = 0;
  for (int r = 0; r < 3; ++r) {
    out.right[r] = sums.total(k++);
    for (int c = 0; c <= r; ++c) {
      out.information(r, c) = out.information(c, r) = sums.total(k++);
      out.spread(r, c) = out.spread(c, r) = sums.total(k++);
    }
  }
  return out;
}

double mean_of(const std::vector<double>& terms) {
  double largest = 0;
  for (const double term : terms) largest = std::max(largest, std::abs(term));
  OrderFreeSum<1> sum({largest}, terms.size());
  for (const double term : terms) sum.add(0, term);
  return sum.total(0) / static_cast<double>(terms.size());
}

CentredPlane ray_step(Points points, const Centred& centred, const CentredPlane& plane,
                      const Residuals& residuals) {
  const NormalEquations equations = normal_equations(points, centred, plane, residuals);
  const Eigen::Vector3d step = equations.information.ldlt().solve(equations.right);
  const Eigen::Vector3d turned = plane.normal + tangent_basis(plane.normal) * step.head<2>();
  return {plane.point + step[2] * plane.normal, turned.normalized()};
}

PlaneFit summarise(Points points, const Centred& centred, CentredPlane plane,
                   const PlaneFitOptions& options) {
  PlaneFit out;
  const std::vector<double> ones(points.size(), 1.0);
  const Eigen::Vector3d mean = moments(points, centred, ones).mean;
  plane.point = mean - plane.normal.dot(mean - plane.point) * plane.normal;
  Residuals residuals = residuals_at(points, centred, plane, options);
  if (options.robust) weigh_robustly(residuals);
  const NormalEquations equations = normal_equations(points, centred, plane, residuals);
  std::vector<double> squared(points.size()), standardised(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    squared[i] = residuals.normal_m[i] * residuals.normal_m[i];
    standardised[i] =
        squared[i] / (residuals.cosine[i] * residuals.cosine[i]) / residuals.expected[i];
  }
  const auto n = static_cast<double>(points.size());
  out.rmse_m = std::sqrt(mean_of(squared));
  out.variance_factor = points.size() > 3 ? mean_of(standardised) * n / (n - 3) : 1;
  const Eigen::Matrix3d inverse = equations.information.inverse();
  out.covariance = out.variance_factor * inverse * equations.spread * inverse;
  out.covariance = (out.covariance + out.covariance.transpose().eval()) / 2;
  out.centroid_m = centred.origin + plane.point;
  out.plane = {plane.normal, plane.normal.dot(out.centroid_m)};
  out.tangent = tangent_basis(plane.normal);
  out.points = points.size();
  return out;
}

}  // namespace

PlaneFit fit_plane(std::span<const Eigen::Vector3d> points, const PlaneFitOptions& options) {
  const bool along_ray = options.method == FitMethod::along_ray;
  if ((along_ray || options.area_weights) && !options.scanner_position)
    throw usage_error("plane fit: fits along the ray and area weights need the scanner's position");
  const Centred centred = centre(points, options);
  CentredPlane plane =
      principal_plane(moments(points, centred, std::vector<double>(points.size(), 1.0)), centred);
  const bool reweighted = options.robust || options.area_weights;
  const int passes = options.robust ? robust_passes : along_ray ? ray_passes : orthogonal_passes;
  for (int pass = 0; pass < passes && (along_ray || reweighted); ++pass) {
    Residuals residuals = residuals_at(points, centred, plane, options);
    if (options.robust) weigh_robustly(residuals);
    plane = along_ray ? ray_step(points, centred, plane, residuals)
                      : principal_plane(moments(points, centred, residuals.weight), centred);
  }
  return summarise(points, centred, plane, options);
}

PlaneFit flipped(const PlaneFit& fit) {
  PlaneFit out = fit;
  out.plane = fit.plane.flipped();
  out.tangent = tangent_basis(out.plane.normal);
  Eigen::Matrix3d turn = -Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = -out.tangent.transpose() * fit.tangent;
  out.covariance = turn * fit.covariance * turn.transpose();
  return out;
}

}  // namespace alea
