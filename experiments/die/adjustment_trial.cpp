#include "experiments/die/adjustment_trial.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "alea/core/parallel.hpp"
#include "alea/die/adjustment.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/evaluate/fisher_bound.hpp"

namespace alea::experiments::die {
namespace {

PairError error_of(const ObservedPair& pair, const RigidTransform& estimate,
                   const TransformCovariance& covariance) {
  PairError out;
  out.error = left_difference(pair.master_from_slave, estimate, pair.centre_m);
  out.nees = out.error.dot(covariance.covariance.ldlt().solve(out.error));
  return out;
}

PairError by_closed_form(const ObservedPair& pair) {
  ClosedFormOptions options;
  options.edge_m = pair.shared_edge_m;
  options.covariance_about_m = pair.centre_m;
  const auto found = register_closed_form(pair.master, pair.slave, options);
  if (!found) return {.refused = true};
  PairError out = error_of(pair, found->master_from_slave, found->covariance);
  out.chi_square = found->misclosure_chi_square;
  out.freedom = found->misclosure_freedom;
  return out;
}

PairError by_adjustment(const ObservedPair& pair, bool shape_known) {
  AdjustmentOptions options;
  options.covariance_about_m = pair.centre_m;
  if (shape_known) {
    options.shape = exact_shape(pair.shape);
  } else {
    const auto shared = shared_pips(pair.master, pair.slave);
    options.shape = free_shape(cube(pair.shared_edge_m, Chirality::clockwise));
    options.edges = {{{shared.at(0), shared.at(1)}, pair.shared_edge_m, 0}};
  }
  const auto found = adjust_die({{pair.master, {}}, {pair.slave, {}}}, options);
  if (!found) return {.refused = true};
  const AdjustedPose& pose = found->poses[1];
  PairError out = error_of(pair, pose.master_from_scan, pose.covariance);
  out.chi_square = found->chi_square;
  out.freedom = found->freedom;
  out.points_factor = 0;
  for (const VarianceComponent& component : found->components)
    if (component.group == "facets")
      out.facets_factor = component.factor;
    else if (component.group == "points")
      out.points_factor += component.factor / 2;
  out.suspect = std::any_of(found->tests.begin(), found->tests.end(),
                            [](const FacetTest& test) { return test.suspect; });
  return out;
}

std::array<double, 2> bound_of(const EfficiencyCase& setting, const DieShape& shape,
                               bool shape_known) {
  DieBoundCase geometry;
  geometry.edge_m = setting.edge_m;
  geometry.range_m = setting.range_m;
  geometry.step_rad = setting.step_rad;
  FisherScene scene = die_bound_scene(geometry);
  std::vector<Plane> planes;
  for (const auto& facet : shape.facets) planes.push_back(*facet);
  scene.bodies = {shape_known ? known_body(planes) : free_body(planes)};
  if (!shape_known)
    scene.bodies[0].edges = {shared_edge(scene.bodies[0], scene.stations[0], scene.stations[1])};
  const PoseAccuracy bound =
      pose_accuracy(*relative_covariance(fisher_bound(scene), 0, 1, {0, 0, setting.edge_m / 2}));
  return {bound.rotation_rad * bound.rotation_rad, bound.translation_m * bound.translation_m};
}

}  // namespace

const char* to_string(PairMethod method) {
  switch (method) {
    case PairMethod::closed_form:
      return "closed form";
    case PairMethod::adjusted_known_shape:
      return "adjustment, shape known";
    case PairMethod::adjusted_free_shape:
      return "adjustment, shape free";
  }
  return "unknown";
}

AdjustmentTrial run_adjustment_trial(const EfficiencyCase& setting, std::uint64_t seed,
                                     std::uint64_t trial) {
  const ObservedPair pair = observe_pair(setting, seed, trial);
  AdjustmentTrial out;
  out.of_method = {by_closed_form(pair), by_adjustment(pair, true), by_adjustment(pair, false)};
  out.known_bound = bound_of(setting, pair.shape, true);
  out.free_bound = bound_of(setting, pair.shape, false);
  return out;
}

std::vector<AdjustmentTrial> run_adjustment_trials(const EfficiencyCase& setting,
                                                   std::uint64_t seed, std::size_t trials) {
  std::vector<AdjustmentTrial> results(trials);
  parallel_chunks(trials, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t trial = begin; trial < end; ++trial)
      results[trial] = run_adjustment_trial(setting, seed, trial);
  });
  return results;
}

}  // namespace alea::experiments::die
