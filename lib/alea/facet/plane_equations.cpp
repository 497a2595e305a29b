#include "alea/facet/plane_equations.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "alea/core/error.hpp"
#include "alea/core/order_free_sum.hpp"

namespace alea {
namespace {

using Points = std::span<const Eigen::Vector3d>;

constexpr double huber_limit = 1.345;   // 95 % efficiency at the normal distribution
constexpr double normal_mad = 0.67449;  // median of |standard normal|
constexpr double least_cosine = 1e-3;   // a ray nearer to the plane's direction tells nothing
constexpr double far_share = 4;         // nor does one that meets the plane this many boxes away
// (1 micrometre)^2, below any scanner: keeps weights finite without noise.
constexpr double least_variance_m2 = 1e-12;

PlaneObservation observe_orthogonally(const Eigen::Vector3d& p, const CentredFrame& frame,
                                      const CentredPlane& plane, const PlaneFitOptions& options) {
  PlaneObservation out;
  out.residual_m = plane.normal.dot(p - plane.point);
  double variance = options.noise.normal_variance_m2(0, 1);
  out.weight = 1;
  if (frame.scanner) {
    const Eigen::Vector3d ray = p - *frame.scanner;
    const double range = ray.norm();
    const double cosine = std::max(least_cosine, -plane.normal.dot(ray) / range);
    variance = options.noise.normal_variance_m2(range, cosine);
    if (options.area_weights) out.weight = range * range / cosine;
  }
  out.variance_m2 = std::max(variance, least_variance_m2);
  return out;
}

/// `at` becomes where the ray meets the plane, relative to plane.point.
PlaneObservation observe_along_ray(const Eigen::Vector3d& p, const CentredFrame& frame,
                                   const CentredPlane& plane, const PlaneFitOptions& options,
                                   Eigen::Vector3d& at) {
  PlaneObservation out;
  const Eigen::Vector3d ray = (p - *frame.scanner).normalized();
  const double slope = -plane.normal.dot(ray);
  const double cosine = std::max(least_cosine, slope);
  const double height = plane.normal.dot(p - plane.point);
  const double range = plane.normal.dot(*frame.scanner - plane.point) / cosine;
  const double variance =
      std::max(least_variance_m2, options.noise.normal_variance_m2(range, cosine));
  at += (height / cosine) * ray;
  out.residual_m = height / cosine;
  out.by_c = 1 / cosine;
  out.variance_m2 = variance / (cosine * cosine);
  out.weight = options.area_weights ? range * range * cosine : 1 / out.variance_m2;
  if (slope < least_cosine || at.squaredNorm() > std::pow(far_share * frame.reach_m, 2))
    out.weight = 0, at.setZero();
  return out;
}

void weigh_robustly(std::vector<PlaneObservation>& observations) {
  std::vector<double> standard;
  standard.reserve(observations.size());
  for (const PlaneObservation& o : observations)
    standard.push_back(std::abs(o.residual_m) / std::sqrt(o.variance_m2));
  std::vector<double> sorted = standard;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double limit = huber_limit * std::max(*middle / normal_mad, 1e-12);
  for (std::size_t i = 0; i < standard.size(); ++i)
    if (standard[i] > limit) observations[i].weight *= limit / standard[i];
}

}  // namespace

CentredFrame centred_frame(Points points, const PlaneFitOptions& options) {
  if (points.size() < 3)
    throw usage_error("plane fit: " + std::to_string(points.size()) +
                      " points given; give at least three that are not on one line");
  Eigen::Vector3d low = points[0], high = points[0];
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  CentredFrame out{low + (high - low) / 2, (high - low).maxCoeff() / 2, std::nullopt};
  if (!std::isfinite(out.reach_m) || !(out.reach_m > 0))
    throw usage_error("plane fit: the points coincide or are not finite; give distinct points");
  if (options.scanner_position) out.scanner = *options.scanner_position - out.origin_m;
  return out;
}

std::vector<PlaneObservation> observe_plane(Points points, const CentredFrame& frame,
                                            const CentredPlane& plane,
                                            const PlaneFitOptions& options) {
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(plane.normal);
  const bool along_ray = options.method == FitMethod::along_ray;
  std::vector<PlaneObservation> out;
  out.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - frame.origin_m;
    Eigen::Vector3d at = p - plane.point;
    out.push_back(along_ray ? observe_along_ray(p, frame, plane, options, at)
                            : observe_orthogonally(p, frame, plane, options));
    PlaneObservation& observation = out.back();
    observation.by_a = -at.dot(tangent.col(0)) * observation.by_c;
    observation.by_b = -at.dot(tangent.col(1)) * observation.by_c;
  }
  if (options.robust) weigh_robustly(out);
  return out;
}

PlaneEquations sum_equations(const std::vector<PlaneObservation>& observations) {
  double j = 0, e = 0, w = 0, s = 0;
  for (const PlaneObservation& o : observations) {
    j = std::max({j, std::abs(o.by_a), std::abs(o.by_b), o.by_c});
    e = std::max(e, std::abs(o.residual_m));
    w = std::max(w, o.weight), s = std::max(s, o.weight * o.weight * o.variance_m2);
  }
  std::array<double, 15> bounds{};
  std::fill_n(bounds.begin(), 3, w * j * e);
  std::fill_n(bounds.begin() + 3, 6, w * j * j);
  std::fill_n(bounds.begin() + 9, 6, s * j * j);
  OrderFreeSum<15> sums(bounds, observations.size());
  for (const PlaneObservation& o : observations) {
    const double q = o.weight * o.variance_m2;
    const std::array<double, 3> jacobian{o.by_a, o.by_b, o.by_c};
    std::size_t k = 3;
    for (std::size_t r = 0; r < 3; ++r) {
      const double wj = o.weight * jacobian[r];
      sums.add(r, wj * o.residual_m);
      for (std::size_t c = 0; c <= r; ++c, ++k) {
        sums.add(k, wj * jacobian[c]);
        sums.add(k + 6, q * wj * jacobian[c]);
      }
    }
  }
  PlaneEquations out;
  std::size_t k = 3;
  for (int r = 0; r < 3; ++r) {
    out.right[r] = sums.total(static_cast<std::size_t>(r));
    for (int c = 0; c <= r; ++c, ++k) {
      out.information(r, c) = out.information(c, r) = sums.total(k);
      out.spread(r, c) = out.spread(c, r) = sums.total(k + 6);
    }
  }
  return out;
}

CentredPlane principal_plane(Points points, const CentredFrame& frame,
                             std::span<const PlaneObservation> weights) {
  double heaviest = weights.empty() ? 1 : 0;
  for (const PlaneObservation& o : weights) heaviest = std::max(heaviest, o.weight);
  std::array<double, 10> bounds{};
  bounds[0] = heaviest;
  std::fill_n(bounds.begin() + 1, 3, heaviest * frame.reach_m);
  std::fill_n(bounds.begin() + 4, 6, heaviest * frame.reach_m * frame.reach_m);
  OrderFreeSum<10> sums(bounds, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i] - frame.origin_m;
    const double weight = weights.empty() ? 1 : weights[i].weight;
    sums.add(0, weight);
    std::size_t k = 4;
    for (int r = 0; r < 3; ++r) {
      sums.add(static_cast<std::size_t>(r) + 1, weight * p[r]);
      for (int c = 0; c <= r; ++c) sums.add(k++, weight * p[r] * p[c]);
    }
  }
  const Eigen::Vector3d mean =
      Eigen::Vector3d(sums.total(1), sums.total(2), sums.total(3)) / sums.total(0);
  Eigen::Matrix3d scatter;
  std::size_t k = 4;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= r; ++c, ++k)
      scatter(r, c) = scatter(c, r) = sums.total(k) / sums.total(0) - mean[r] * mean[c];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  if (!(solver.eigenvalues()[1] > 1e-12 * solver.eigenvalues()[2]))
    throw usage_error("plane fit: the points lie on one line; give points that span a surface");
  CentredPlane out{mean, solver.eigenvectors().col(0)};
  const Eigen::Vector3d outside = frame.scanner.value_or(-frame.origin_m);
  if (out.normal.dot(outside - out.point) < 0) out.normal = -out.normal;
  return out;
}

double order_free_mean(const std::vector<PlaneObservation>& observations,
                       double (*value)(const PlaneObservation&)) {
  double largest = 0;
  for (const PlaneObservation& o : observations) largest = std::max(largest, std::abs(value(o)));
  OrderFreeSum<1> sum({largest}, observations.size());
  for (const PlaneObservation& o : observations) sum.add(0, value(o));
  return sum.total(0) / static_cast<double>(observations.size());
}

}  // namespace alea
