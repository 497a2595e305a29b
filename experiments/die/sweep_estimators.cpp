#include "experiments/die/sweep_estimators.hpp"

#include <cmath>

#include "alea/die/adjustment.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/paper_registration.hpp"
#include "experiments/die/mixed_axes.hpp"
#include "experiments/die/sweep_comparators.hpp"

namespace alea::experiments::die {
namespace {

constexpr int upper = 1;  // pips of the facet that looks up

DieShape shape_of(const Die& die) {
  DieShape shape;
  for (int f = 0; f < 6; ++f) shape.facets[f] = die.body.planes[f];
  return shape;
}

/// Length that is given for the edge between the shared facets, where there is one.
double given_edge_m(const SweepSight& sight) {
  const auto shared = shared_pips(sight.facets[0], sight.facets[1]);
  if (!sight.setting.true_length || shared.size() != 2) return sight.setting.edge_m;
  return edge_length_m(sight.scans.die.body, shared[0], shared[1]);
}

Result<RigidTransform> closed_form(const SweepSight& sight, bool shape_known) {
  ClosedFormOptions options;
  options.edge_m = given_edge_m(sight);
  if (sight.setting.tilt_prior_rad > 0) options.tilt_prior_rad = sight.setting.tilt_prior_rad;
  if (shape_known) options.shape = shape_of(sight.scans.die);
  const auto result = register_closed_form(sight.facets[0], sight.facets[1], options);
  if (!result) return result.refusal();
  return result->master_from_slave;
}

Result<RigidTransform> by_closed_form(const SweepSight& sight) {
  return closed_form(sight, false);
}

Result<RigidTransform> by_known_shape(const SweepSight& sight) {
  return closed_form(sight, true);
}

/// Joint least squares of both scans: with the shape known, with a tilt prior, or free with the
/// shared edge's length.
Result<RigidTransform> adjustment(const SweepSight& sight, bool shape_known) {
  AdjustmentOptions options;
  const DieCase& setting = sight.setting;
  const DieShape nominal = cube(setting.edge_m, Chirality::clockwise);
  const auto shared = shared_pips(sight.facets[0], sight.facets[1]);
  if (shape_known)
    options.shape = exact_shape(centred(shape_of(sight.scans.die)).shape);
  else if (setting.tilt_prior_rad > 0)
    // An edge differs from the distance of the facets' centres by about the tilt times its length.
    options.shape = normal_shape(nominal, setting.tilt_prior_rad,
                                 setting.edge_m * setting.tilt_prior_rad / std::sqrt(2.0));
  else
    options.shape = free_shape(nominal);
  if (!shape_known && shared.size() == 2)
    options.edges = {{{shared[0], shared[1]}, given_edge_m(sight), 0}};
  const auto result = adjust_die({{sight.facets[0], {}}, {sight.facets[1], {}}}, options);
  if (!result) return result.refusal();
  if (!result->poses[1].determined)
    return Refusal{RefusalCode::unobservable, "the stations leave a direction open"};
  return result->poses[1].master_from_scan;
}

Result<RigidTransform> by_adjustment(const SweepSight& sight) {
  return adjustment(sight, false);
}

Result<RigidTransform> by_adjustment_known_shape(const SweepSight& sight) {
  return adjustment(sight, true);
}

Result<RigidTransform> by_axes(const std::array<ObservedDie, 2>& facets, double edge_m,
                               FrameRule rule, const PrintedErrors& errors = {}) {
  PaperRegistrationOptions options;
  options.dimensions = {edge_m, edge_m, edge_m};
  options.rule = rule;
  options.errors = errors;
  options.up_pips = upper;
  const auto result = register_paper(facets[0], facets[1], options);
  if (!result) return result.refusal();
  return result->master_from_slave;
}

template <FrameRule rule>
Result<RigidTransform> by_rule(const SweepSight& sight) {
  return by_axes(sight.facets, given_edge_m(sight), rule);
}

Result<RigidTransform> by_paper(const SweepSight& sight) {
  return by_axes(sight.paper_facets, given_edge_m(sight), FrameRule::fix_z);
}

Result<RigidTransform> by_paper_literal(const SweepSight& sight) {
  return by_axes(sight.paper_facets, given_edge_m(sight), FrameRule::fix_z,
                 PrintedErrors::as_printed());
}

Result<RigidTransform> by_mixed_axes(const SweepSight& sight) {
  const auto shared = shared_pips(sight.facets[0], sight.facets[1]);
  if (shared.size() != 2)
    return Refusal{RefusalCode::unobservable, "mixed axes need two shared facets"};
  const auto edge = closed_form(sight, false);
  if (!edge) return edge.refusal();
  return turn_by_mixed_axes(sight.facets[0], sight.facets[1], *edge);
}

}  // namespace

const std::vector<SweepEstimator>& sweep_estimators() {
  using enum BoundKind;
  static const std::vector<SweepEstimator> estimators{
      {"closed_form", "shared edge and both shared facets", true, false, free_shape,
       by_closed_form},
      {"known_shape", "closed form on the calibrated shape", true, false, known_shape,
       by_known_shape},
      {"adjustment", "joint least squares, the shared edge known", true, false, free_shape,
       by_adjustment},
      {"adjustment_known_shape", "joint least squares on the calibrated shape", true, false,
       known_shape, by_adjustment_known_shape},
      {"paper", "equations 1 to 8 corrected: orthogonal fits, vertical edge fixed", true, true,
       free_shape, by_paper},
      {"paper_literal", "equations 1 to 8 as printed", true, true, free_shape, by_paper_literal},
      {"fix_x", "X fixed, fits along the ray", true, false, free_shape, by_rule<FrameRule::fix_x>},
      {"fix_y", "Y fixed", true, false, free_shape, by_rule<FrameRule::fix_y>},
      {"fix_z", "Z fixed", true, false, free_shape, by_rule<FrameRule::fix_z>},
      {"polar", "the nearest rotation", true, false, free_shape, by_rule<FrameRule::polar>},
      {"mixed", "the shared edge fixed, second axis from another facet at each station", true,
       false, free_shape, by_mixed_axes},
      {"spheres", "six spheres on a ring of 4 m", false, false, spheres, by_spheres},
      {"planes", "four calibration planes and no die", false, false, planes, by_planes},
  };
  return estimators;
}

const SweepEstimator& sweep_estimator(const std::string& name) {
  for (const SweepEstimator& estimator : sweep_estimators())
    if (estimator.name == name) return estimator;
  return sweep_estimators().front();
}

}  // namespace alea::experiments::die
