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

/// One point's part of the linearised problem.
struct Row {
  Eigen::Vector4d jacobian;  ///< of the predicted value, by centre and radius
  double residual;           ///< measured minus predicted
  double sd;                 ///< expected of the residual
  double along_normal;       ///< residual times this is a distance along the normal
  double sine;               ///< of the incidence angle that the ray should have
};

/// Empty where the ray misses the sphere or only touches it.
std::optional<Row> row_of(const Eigen::Vector3d& point, const State& state,
                          const SphereFitOptions& options) {
  const double range = point.norm();
  const Eigen::Vector3d ray = point / range;
  const double sine = ray.cross(state.centre).norm() / state.radius;
  if (!(sine < largest_sine)) return std::nullopt;
  const double cosine = std::sqrt(1 - sine * sine);
  const double predicted = ray.dot(state.centre) - state.radius * cosine;
  const double normal_sd = options.noise.normal_sd_m(predicted, cosine);
  Row row;
  if (options.method == SphereFitMethod::along_ray) {
    const Eigen::Vector3d normal = (predicted * ray - state.centre) / state.radius;
    row.jacobian << -normal / cosine, -1 / cosine;
    row.residual = range - predicted;
    row.sd = normal_sd / cosine;
    row.along_normal = cosine;
  } else {
    const Eigen::Vector3d lever = point - state.centre;
    row.jacobian << lever.normalized(), 1;
    row.residual = lever.norm() - state.radius;
    row.sd = normal_sd;
    row.along_normal = 1;
  }
  row.sine = sine;
  return row;
}

/// Sums over the points that take part.
struct Sums {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d spread = Eigen::Matrix4d::Zero();  ///< J' W S W J
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double standardised = 0;  ///< squared residuals over their variances
  double squared_m2 = 0;    ///< along the normal
  std::size_t points = 0;
};

/// The points whose rays meet the sphere steeply enough and whose residuals pass the gate.
std::vector<Eigen::Vector3d> members_of(const std::vector<Eigen::Vector3d>& points,
                                        const State& state, double gate,
                                        const SphereFitOptions& options) {
  std::vector<Eigen::Vector3d> members;
  for (const Eigen::Vector3d& point : points) {
    const std::optional<Row> row = row_of(point, state, options);
    if (row && row->sine < std::sin(options.max_incidence_rad) &&
        std::abs(row->residual) <= gate * row->sd)
      members.push_back(point);
  }
  return members;
}

Sums sums_of(const std::vector<Eigen::Vector3d>& points, const State& state,
             const SphereFitOptions& options) {
  Sums sums;
  for (const Eigen::Vector3d& point : points) {
    const std::optional<Row> row = row_of(point, state, options);
    if (!row) continue;
    const double variance = row->sd * row->sd;
    const double weight = options.method == SphereFitMethod::along_ray ? 1 / variance : 1;
    const Eigen::Matrix4d square = row->jacobian * row->jacobian.transpose();
    sums.normal += weight * square;
    sums.spread += weight * weight * variance * square;
    sums.right += weight * row->residual * row->jacobian;
    sums.standardised += row->residual * row->residual / variance;
    const double distance = row->residual * row->along_normal;
    sums.squared_m2 += distance * distance;
    ++sums.points;
  }
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
  const Eigen::Matrix4d covariance = fit.variance_factor * inverse * sums.spread * inverse;
  fit.covariance = covariance.topLeftCorner<3, 3>();
  fit.radius_sd_m = std::sqrt(covariance(3, 3));
  return fit;
}

/// The points relative to the scanner, in an order that is theirs alone.
std::vector<Eigen::Vector3d> ordered(std::span<const Eigen::Vector3d> points,
                                     const Eigen::Vector3d& scanner_position) {
  std::vector<Eigen::Vector3d> out;
  out.reserve(points.size());
  for (const Eigen::Vector3d& point : points)
    if (point != scanner_position) out.push_back(point - scanner_position);
  std::sort(out.begin(), out.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return out;
}

}  // namespace

Result<SphereFit> fit_sphere(std::span<const Eigen::Vector3d> points,
                             const Eigen::Vector3d& start_centre_m,
                             const SphereFitOptions& options) {
  if (!(options.radius_m > 0)) throw usage_error("sphere fit: give a positive radius in metres");
  const std::vector<Eigen::Vector3d> rays = ordered(points, options.scanner_position);
  const int unknowns = options.radius_known ? 3 : 4;
  State state{start_centre_m - options.scanner_position, options.radius_m};
  // The gate closes step by step from a third of the radius: as far as the start may be off.
  const double sd_m = options.noise.normal_sd_m(state.centre.norm(), 1);
  double opening = std::max(1.0, state.radius / 3 / (options.gate_sd * std::max(sd_m, 1e-9)));
  double scale = 1;
  std::vector<Eigen::Vector3d> members;
  bool selecting = true;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (selecting) members = members_of(rays, state, options.gate_sd * scale * opening, options);
    const Sums sums = sums_of(members, state, options);
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
