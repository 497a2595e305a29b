#include "alea/facet/plane_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "alea/cloud/coordinate_step.hpp"
#include "alea/core/error.hpp"
#include "alea/core/order_free_sum.hpp"
#include "alea/facet/plane_equations.hpp"

namespace alea {
namespace {

using Points = std::span<const Eigen::Vector3d>;

constexpr int max_passes = 12;
// Far below the noise of any scan; a pass squares the error, so the next one would change nothing.
constexpr double plane_settled_rad = 1e-7, plane_settled_m = 1e-8;
constexpr double least_noise_m = 1e-7;  // points that lie exactly on a plane are not exact
constexpr double dithered_share = 0.2;  // of the rounding step: less noise than that rounds alike

void check_options(const PlaneFitOptions& options) {
  if ((options.method == FitMethod::along_ray || options.area_weights) && !options.scanner_position)
    throw usage_error("plane fit: fits along the ray and area weights need the scanner's position");
}

/// Principal components: one pass, wherever it starts.
bool is_principal(const PlaneFitOptions& options) {
  return options.method == FitMethod::orthogonal && !options.area_weights && !options.robust;
}

CentredPlane pass_once(Points points, const CentredFrame& frame, const CentredPlane& plane,
                       const PlaneFitOptions& options) {
  if (is_principal(options)) return principal_plane(points, frame, {});
  const std::vector<PlaneObservation> observations = observe_plane(points, frame, plane, options);
  if (options.method == FitMethod::orthogonal) return principal_plane(points, frame, observations);
  const PlaneEquations equations = sum_equations(observations);
  const Eigen::Vector3d step = equations.information.ldlt().solve(equations.right);
  const Eigen::Vector3d turned = plane.normal + tangent_basis(plane.normal) * step.head<2>();
  return {plane.point + step[2] * plane.normal, turned.normalized()};
}

bool settled(const CentredPlane& before, const CentredPlane& after) {
  return (after.normal - before.normal).norm() < plane_settled_rad &&
         std::abs(after.normal.dot(before.point - after.point)) < plane_settled_m;
}

/// The least variance factor that rounding allows.
double rounding_factor(const std::vector<PlaneObservation>& observations, double step_m) {
  const double variance_m2 = std::max(step_m * step_m / 12, least_noise_m * least_noise_m);
  return variance_m2 * order_free_mean(observations, [](const PlaneObservation& o) {
           return o.by_c * o.by_c / o.variance_m2;
         });
}

PlaneFit summarise(Points points, const CentredFrame& frame, CentredPlane plane,
                   const Eigen::Vector3d& mean, const PlaneFitOptions& options) {
  PlaneFit out;
  plane.point = mean - plane.normal.dot(mean - plane.point) * plane.normal;
  const std::vector<PlaneObservation> observations = observe_plane(points, frame, plane, options);
  const PlaneEquations equations = sum_equations(observations);
  out.rmse_m = std::sqrt(order_free_mean(
      observations, [](const PlaneObservation& o) { return std::pow(o.residual_m / o.by_c, 2); }));
  const auto n = static_cast<double>(points.size());
  if (points.size() > 3)
    out.variance_factor =
        n / (n - 3) * order_free_mean(observations, [](const PlaneObservation& o) {
          return o.residual_m * o.residual_m / o.variance_m2;
        });
  const double step_m = coordinate_step_m(points);
  const double rounding = rounding_factor(observations, step_m);
  out.variance_factor = std::max(out.variance_factor, rounding);
  const bool rounded_alike = out.rmse_m < dithered_share * step_m;
  const double factor = rounded_alike ? n * rounding : out.variance_factor;
  const Eigen::Matrix3d inverse = equations.information.inverse();
  const Eigen::Matrix3d covariance = factor * inverse * equations.spread * inverse;
  out.covariance = (covariance + covariance.transpose()) / 2;
  out.centroid_m = frame.origin_m + plane.point;
  out.plane = {plane.normal, plane.normal.dot(out.centroid_m)};
  out.tangent = tangent_basis(plane.normal);
  out.points = points.size();
  return out;
}

CentredPlane in_frame(const Plane& plane, const CentredFrame& frame) {
  return {-plane.signed_distance(frame.origin_m) * plane.normal, plane.normal};
}

PlaneFit fit_from(Points points, const CentredFrame& frame, const std::optional<Plane>& start,
                  const PlaneFitOptions& options) {
  const CentredPlane principal = principal_plane(points, frame, {});
  if (is_principal(options)) return summarise(points, frame, principal, principal.point, options);
  CentredPlane plane = start ? in_frame(*start, frame) : principal;
  for (int pass = 0; pass < max_passes; ++pass) {
    const CentredPlane before = plane;
    plane = pass_once(points, frame, plane, options);
    if (settled(before, plane)) break;
  }
  return summarise(points, frame, plane, principal.point, options);
}

}  // namespace

PlaneFit fit_plane(Points points, const PlaneFitOptions& options) {
  check_options(options);
  const CentredFrame frame = centred_frame(points, options);
  return fit_from(points, frame, std::nullopt, options);
}

PlaneFit fit_plane(Points points, const Plane& start, const PlaneFitOptions& options) {
  check_options(options);
  const CentredFrame frame = centred_frame(points, options);
  return fit_from(points, frame, start, options);
}

Plane improve_plane(Points points, const Plane& start, const PlaneFitOptions& options) {
  check_options(options);
  const CentredFrame frame = centred_frame(points, options);
  const CentredPlane plane = pass_once(points, frame, in_frame(start, frame), options);
  return {plane.normal, plane.normal.dot(frame.origin_m + plane.point)};
}

double orthogonal_rmse_m(Points points) {
  const CentredFrame frame = centred_frame(points, {});
  const CentredPlane plane = principal_plane(points, frame, {});
  const auto square = [&](const Eigen::Vector3d& p) {
    return std::pow(plane.normal.dot(p - frame.origin_m - plane.point), 2);
  };
  double largest = 0;
  for (const Eigen::Vector3d& p : points) largest = std::max(largest, square(p));
  OrderFreeSum<1> squares({largest}, points.size());
  for (const Eigen::Vector3d& p : points) squares.add(0, square(p));
  return std::sqrt(squares.total(0) / static_cast<double>(points.size()));
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
