#include "alea/transform/icp.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/transform/icp_equations.hpp"

namespace alea {
namespace {

void require_arrays(const IcpTarget::Data& target, const IcpPoints& source,
                    const IcpOptions& options) {
  const bool coloured = options.objective == IcpObjective::coloured;
  if (options.objective != IcpObjective::point_to_point && target.points.normals.empty())
    throw usage_error("icp: the target has no normals; estimate them first");
  if (coloured && target.gradients.empty())
    throw usage_error("icp: the target was not made for the coloured objective");
  if (coloured && source.intensity.empty())
    throw usage_error("icp: the coloured objective needs a source with intensities or colours");
  if (options.normal_angle_rad < std::numbers::pi / 2 &&
      (source.normals.empty() || target.points.normals.empty()))
    throw usage_error("icp: normal_angle_rad needs normals of both clouds");
}

/// A turn about the mean of the pairs and a shift: the mean goes where the linear system sends it,
/// however large the turn. A screw (the exponential of both at once) would turn its way by half.
RigidTransform moved_about(const Eigen::Vector3d& mean, const Vector6d& delta) {
  const Eigen::Matrix3d rotation = rotation_exp(delta.head<3>());
  return {rotation, mean - rotation * mean + delta.tail<3>()};
}

/// One alignment in the clouds' own local frames.
class Solver {
 public:
  Solver(const IcpTarget::Data& target, const IcpPoints& source, const IcpOptions& options)
      : target_(target), source_(source), options_(options) {}

  IcpResult run(const RigidTransform& start) {
    IcpResult result;
    result.target_from_source = start;
    while (true) {
      const double fitness = result.fitness, rmse = result.rmse_m;
      pair(result);
      if (pairs_.count < (is_closed_form() ? 3u : 6u)) {
        result.stop = IcpStop::too_few_pairs;
        return result;
      }
      const IcpSystem system = icp_system(target_, source_, pairs_, options_);
      const IcpStep step = solve(system, options_.null_space_share);
      describe(system, step, result);
      if (const auto stop = reason_to_stop(fitness, rmse, result)) {
        result.stop = *stop;
        return result;
      }
      advance(system, step, result);
    }
  }

 private:
  bool is_closed_form() const { return options_.objective == IcpObjective::point_to_point; }

  void pair(IcpResult& result) {
    update_pairs(target_, source_, result.target_from_source, options_, pairs_);
    result.pairs = pairs_.count;
    result.fitness =
        static_cast<double>(pairs_.count) / static_cast<double>(source_.positions.size());
  }

  void describe(const IcpSystem& system, const IcpStep& step, IcpResult& result) const {
    const auto n = static_cast<double>(pairs_.count);
    result.rmse_m = std::sqrt(system.distance_squares / n);
    result.normal_rmse_m = is_closed_form() ? 0 : std::sqrt(system.geometric.squares / n);
    result.intensity_rmse = std::sqrt(system.photometric.squares / n);
    result.gain = system.gain;
    result.offset = system.offset;
    result.determined = step.determined;
    // Three coordinates a pair, or one residual a term.
    const bool two_terms = options_.objective == IcpObjective::coloured;
    const double rows = n * (is_closed_form() ? 3 : two_terms ? 2 : 1);
    const double squares = system.geometric_weight * system.geometric.squares +
                           system.photometric_weight * system.photometric.squares;
    const double variance = std::max(squares / std::max(rows - 6, 1.0), 1e-300);
    result.information = system.normal_matrix() / variance;
    result.information_about_m = system.about;
  }

  std::optional<IcpStop> reason_to_stop(double fitness_before, double rmse_before,
                                        const IcpResult& result) const {
    if (result.determined == 0) return IcpStop::undetermined;
    if (result.iterations > 0) {
      if (turn_ <= options_.rotation_tolerance_rad && shift_ <= options_.translation_tolerance_m)
        return IcpStop::step_small;
      if (std::abs(result.fitness - fitness_before) < options_.settled_change &&
          std::abs(result.rmse_m - rmse_before) < options_.settled_change * rmse_before)
        return IcpStop::residual_settled;
    }
    if (result.iterations == options_.max_iterations) return IcpStop::iteration_limit;
    return std::nullopt;
  }

  void advance(const IcpSystem& system, const IcpStep& step, IcpResult& result) {
    const RigidTransform after_from_before = is_closed_form()
                                                 ? closed_form_step(target_, pairs_, options_)
                                                 : moved_about(system.about, step.delta);
    turn_ = rotation_angle_rad(after_from_before.rotation);
    shift_ = (after_from_before * system.about - system.about).norm();
    result.target_from_source = after_from_before * result.target_from_source;
    ++result.iterations;
  }

  const IcpTarget::Data& target_;
  const IcpPoints& source_;
  const IcpOptions& options_;
  IcpPairs pairs_;
  double turn_ = 0, shift_ = 0;  // of the last step
};

RigidTransform shift_by(const Eigen::Vector3d& translation) {
  return {Eigen::Matrix3d::Identity(), translation};
}

}  // namespace

const char* to_string(IcpStop stop) {
  switch (stop) {
    case IcpStop::step_small:
      return "step_small";
    case IcpStop::residual_settled:
      return "residual_settled";
    case IcpStop::iteration_limit:
      return "iteration_limit";
    case IcpStop::too_few_pairs:
      return "too_few_pairs";
    case IcpStop::undetermined:
      return "undetermined";
  }
  return "unknown";
}

IcpResult icp(const IcpTarget& target, const Cloud& source, const RigidTransform& start,
              const IcpOptions& options) {
  require_valid(options);
  const IcpPoints points = icp_points(source, "source");
  const IcpTarget::Data& data = target.data();
  require_arrays(data, points, options);
  const RigidTransform local_start =
      shift_by(-data.points.origin) * start * shift_by(points.origin);
  IcpResult result = Solver(data, points, options).run(local_start);
  result.target_from_source =
      shift_by(data.points.origin) * result.target_from_source * shift_by(-points.origin);
  result.information_about_m += data.points.origin;
  return result;
}

IcpResult icp(const Cloud& target, const Cloud& source, const RigidTransform& start,
              const IcpOptions& options) {
  return icp(IcpTarget(target, options), source, start, options);
}

}  // namespace alea
