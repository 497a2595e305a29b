#include "alea/sphere/sphere_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/error.hpp"

namespace alea {
namespace {

constexpr int selecting_iterations = 20;  // then the members stay, so that the search can settle
constexpr int max_iterations = 50;
constexpr double settled_m = 1e-6;
constexpr double converged_m = 1e-10;
constexpr double largest_sine = 0.9999;  // beyond, a ray only touches the sphere

/// The state of the search, relative to the scanner.
struct State {
  Eigen::Vector3d centre;
  double radius;
};

/// A point as the scanner measured it.
struct MeasuredRay {
  Eigen::Vector3d direction;
  double range;
};

/// One point's part of the linearised problem.
struct Row {
  Eigen::Vector4d jacobian;  ///< of the predicted value, by centre and radius
  double residual;           ///< measured minus predicted
  double variance;           ///< expected of the residual
  double along_normal;       ///< residual times this is a distance along the normal
};

/// Empty where the ray would meet the sphere at more than this sine of the incidence angle.
std::optional<Row> row_of(const MeasuredRay& ray, const State& state, double sine_limit,
                          const SphereFitOptions& options) {
  const double sine2 =
      ray.direction.cross(state.centre).squaredNorm() / (state.radius * state.radius);
  if (!(sine2 < sine_limit * sine_limit)) return std::nullopt;
  const double cosine = std::sqrt(1 - sine2);
  const double predicted = ray.direction.dot(state.centre) - state.radius * cosine;
  const double normal_variance = options.noise.normal_variance_m2(predicted, cosine);
  Row row;
  if (options.method == SphereFitMethod::along_ray) {
    row.jacobian << (state.centre - predicted * ray.direction) / (state.radius * cosine),
        -1 / cosine;
    row.residual = ray.range - predicted;
    row.variance = normal_variance / (cosine * cosine);
    row.along_normal = cosine;
  } else {
    const Eigen::Vector3d lever = ray.range * ray.direction - state.centre;
    row.jacobian << lever.normalized(), 1;
    row.residual = lever.norm() - state.radius;
    row.variance = normal_variance;
    row.along_normal = 1;
  }
  return row;
}

/// Sums over the points that take part.
struct Sums {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d spread = Eigen::Matrix4d::Zero();  ///< J' W S W J, where it is not J' W J
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double standardised = 0;  ///< squared residuals over their variances
  double squared_m2 = 0;    ///< along the normal
  std::size_t points = 0;
};

void add(const Row& row, SphereFitMethod method, Sums& sums) {
  const bool along_ray = method == SphereFitMethod::along_ray;
  const Eigen::Vector4d weighted = along_ray ? row.jacobian / row.variance : row.jacobian;
  sums.normal.noalias() += weighted * row.jacobian.transpose();
  if (!along_ray) sums.spread.noalias() += row.variance * row.jacobian * row.jacobian.transpose();
  sums.right += row.residual * weighted;
  sums.standardised += row.residual * row.residual / row.variance;
  const double distance = row.residual * row.along_normal;
  sums.squared_m2 += distance * distance;
  ++sums.points;
}

/// The points whose rays meet the sphere steeply enough and whose residuals pass the gate, and
/// their sums.
struct Selected {
  std::vector<MeasuredRay> members;
  Sums sums;
};

Selected select(const std::vector<MeasuredRay>& rays, const State& state, double gate,
                const SphereFitOptions& options) {
  const double sine_limit = std::min(largest_sine, std::sin(options.max_incidence_rad));
  Selected out;
  out.members.reserve(rays.size());
  for (const MeasuredRay& ray : rays) {
    const std::optional<Row> row = row_of(ray, state, sine_limit, options);
    if (!row || row->residual * row->residual > gate * gate * row->variance) continue;
    out.members.push_back(ray);
    add(*row, options.method, out.sums);
  }
  return out;
}

Sums sums_of(const std::vector<MeasuredRay>& members, const State& state,
             const SphereFitOptions& options) {
  Sums sums;
  for (const MeasuredRay& ray : members)
    if (const std::optional<Row> row = row_of(ray, state, largest_sine, options))
      add(*row, options.method, sums);
  return sums;
}

Eigen::Matrix4d inverse_of(const Eigen::Matrix4d& normal, int unknowns) {
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();
  inverse.topLeftCorner(unknowns, unknowns) =
      normal.topLeftCorner(unknowns, unknowns)
          .ldlt()
          .solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  return inverse;
}

SphereFit result_of(const State& state, const Sums& sums, int unknowns,
                    const SphereFitOptions& options) {
  SphereFit fit;
  const double count = static_cast<double>(sums.points);
  fit.centre_m = state.centre + options.scanner_position;
  fit.radius_m = state.radius;
  fit.points = sums.points;
  fit.rmse_m = std::sqrt(sums.squared_m2 / count);
  fit.variance_factor = sums.standardised / (count - unknowns);
  const Eigen::Matrix4d inverse = inverse_of(sums.normal, unknowns);
  const bool along_ray = options.method == SphereFitMethod::along_ray;
  const Eigen::Matrix4d spread = along_ray ? sums.normal : sums.spread;
  const Eigen::Matrix4d covariance = fit.variance_factor * inverse * spread * inverse;
  fit.covariance = covariance.topLeftCorner<3, 3>();
  fit.radius_sd_m = std::sqrt(covariance(3, 3));
  return fit;
}

bool comes_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  return a.y() != b.y() ? a.y() < b.y() : a.z() < b.z();
}

/// The points as rays of the scanner, in an order that is theirs alone.
std::vector<MeasuredRay> rays_of(std::span<const Eigen::Vector3d> points,
                                 const Eigen::Vector3d& scanner_position) {
  std::vector<Eigen::Vector3d> ordered;
  ordered.reserve(points.size());
  for (const Eigen::Vector3d& point : points)
    if (point != scanner_position) ordered.push_back(point - scanner_position);
  std::sort(ordered.begin(), ordered.end(), comes_before);
  std::vector<MeasuredRay> rays;
  rays.reserve(ordered.size());
  for (const Eigen::Vector3d& point : ordered) {
    const double range = point.norm();
    rays.push_back({point / range, range});
  }
  return rays;
}

}  // namespace

Result<SphereFit> fit_sphere(std::span<const Eigen::Vector3d> points,
                             const Eigen::Vector3d& start_centre_m,
                             const SphereFitOptions& options) {
  if (!(options.radius_m > 0)) throw usage_error("sphere fit: give a positive radius in metres");
  const std::vector<MeasuredRay> rays = rays_of(points, options.scanner_position);
  const int unknowns = options.radius_known ? 3 : 4;
  State state{start_centre_m - options.scanner_position, options.radius_m};
  // The gate closes step by step from a third of the radius: as far as the start may be off.
  const double sd_m = options.noise.normal_sd_m(state.centre.norm(), 1);
  double opening = std::max(1.0, state.radius / 3 / (options.gate_sd * std::max(sd_m, 1e-9)));
  double scale = 1;
  Selected selected;
  bool selecting = true;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (selecting)
      selected = select(rays, state, options.gate_sd * scale * opening, options);
    else
      selected.sums = sums_of(selected.members, state, options);
    const Sums& sums = selected.sums;
    if (sums.points < std::max<std::size_t>(options.min_points, unknowns + 1))
      return Refusal{RefusalCode::too_few_points,
                     "sphere: " + std::to_string(sums.points) + " points on it, " +
                         std::to_string(options.min_points) + " are needed; scan it more densely"};
    const Eigen::Vector4d step = inverse_of(sums.normal, unknowns) * sums.right;
    if (!selecting && step.norm() < converged_m) return result_of(state, sums, unknowns, options);
    selecting =
        selecting && iteration < selecting_iterations && (opening > 1 || step.norm() > settled_m);
    // No step beyond a third of the radius: from there the linearisation says nothing.
    const double limit = std::min(1.0, state.radius / 3 / std::max(step.norm(), 1e-300));
    state.centre += limit * step.head<3>();
    state.radius += limit * step[3];
    // A scanner noisier than its model keeps its own tails; at most three times.
    if (opening == 1)
      scale = std::clamp(std::sqrt(sums.standardised / static_cast<double>(sums.points)), 1.0, 3.0);
    opening = std::max(1.0, opening / 2);
    if (!(state.radius > 0) || !(state.centre.norm() > state.radius)) break;
  }
  return Refusal{RefusalCode::no_convergence, "sphere: the fit does not settle on a radius of " +
                                                  std::to_string(options.radius_m) +
                                                  " m; check the radius"};
}

}  // namespace alea
