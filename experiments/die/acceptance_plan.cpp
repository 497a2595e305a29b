#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/evaluate/error_map.hpp"
#include "alea/evaluate/plan.hpp"
#include "alea/pipeline/register_die.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/engine/sample_mean.hpp"

namespace alea::acceptance {
namespace {

constexpr std::uint64_t plan_trials = 10000;
constexpr std::uint32_t experiment_number = 34;
constexpr double plan_edge_m = 0.5, plan_range_m = 6, plan_step_rad = 1e-3,
                 plan_tilt_sd_rad = 0.00698;

DieModel standing_die() {
  DieModel model;
  model.size_m.setConstant(plan_edge_m);
  model.edge_radius_m = 0.005;
  model.scene_from_die = standing_pose(model.chirality, 1, 2, 0, {0, 0, plan_edge_m / 2});
  return model;
}

/// The die that is planned with is a perfect cube; those that are scanned have tilted facets.
Scene scene_with(const Die& die, const RandomStream* phases) {
  Scene scene;
  scene.dice = {die};
  DieBoundCase geometry;
  geometry.edge_m = plan_edge_m;
  geometry.range_m = plan_range_m;
  std::uint64_t index = 0;
  for (const FisherStation& station : die_bound_scene(geometry).stations) {
    Eigen::Vector2d phase(0.5, 0.5);
    if (phases != nullptr) {
      const auto [column, row] = phases->uniform2_at(index++);
      phase = {column, row};
    }
    scene.stations.push_back(
        aimed_station(station.scene_from_scan, bounding_ball(die), plan_step_rad, phase));
    scene.stations.back().name = fmt::format("station {}", scene.stations.size());
  }
  return scene;
}

/// True length of the edge between the two facets that both stations see.
double shared_edge_m(const Scene& scene) {
  DieShape shape;
  for (int f = 0; f < 6; ++f) shape.facets[f] = scene.dice[0].body.planes[f];
  const auto first = facing_pips(shape, scene.stations[0].scene_from_scan.translation);
  const auto second = facing_pips(shape, scene.stations[1].scene_from_scan.translation);
  std::vector<int> shared;
  for (const int pips : first)
    if (std::find(second.begin(), second.end(), pips) != second.end()) shared.push_back(pips);
  return edge_length_m(scene.dice[0].body, shared.at(0), shared.at(1));
}

/// Nine places at eye level: the corners, the sides' middles and the centre of a square of 8 m
/// about the die. Scene frame.
std::vector<Eigen::Vector3d> places() {
  std::vector<Eigen::Vector3d> out;
  for (const double x : {-4.0, 0.0, 4.0})
    for (const double y : {-4.0, 0.0, 4.0}) out.emplace_back(x, y, 1.5);
  return out;
}

/// Squared displacement of each place by the error of one registration; empty where it was refused.
std::vector<double> squared_displacements(std::uint64_t seed, std::uint64_t trial) {
  const Die die = build_die(
      with_random_shape(standing_die(), {plan_tilt_sd_rad, 0, 0}, seed, experiment_number, trial));
  const RandomStream phases({seed, experiment_number, trial, 0, Purpose::station});
  const Scene scene = scene_with(die, &phases);
  std::vector<Cloud> scans;
  for (std::uint32_t s = 0; s < 2; ++s) {
    scans.push_back(simulate_scan(scene, scene.stations[s], {seed, experiment_number, trial, s}));
    scans.back().scanner_position = Eigen::Vector3d::Zero();
  }
  DieRegistrationOptions options;
  options.edge_m = shared_edge_m(scene);
  const RigidTransform master_from_scene = scene.stations[0].scene_from_scan.inverse();
  const RigidTransform truth = master_from_scene * scene.stations[1].scene_from_scan;
  const Registration found = register_die(scans[0], scans[1], options);
  if (!found.master_from_slave) return {};
  std::vector<double> out;
  for (const Eigen::Vector3d& place : places())
    out.push_back(left_difference(truth, *found.master_from_slave, master_from_scene * place)
                      .tail<3>()
                      .squaredNorm());
  return out;
}

}  // namespace

void run_plan(const Options& options, const Report& report) {
  std::vector<std::vector<double>> trials(options.trials_or(plan_trials));
  parallel_chunks(trials.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) trials[t] = squared_displacements(options.seed, t);
  });
  PlanAssumptions assumptions;
  assumptions.fitted_facets = true;
  const Scene planned = scene_with(build_die(standing_die()), nullptr);
  const TransformCovariance covariance = *plan_pairs(planned, assumptions).front().covariance;
  const RigidTransform master_from_scene = planned.stations[0].scene_from_scan.inverse();
  std::size_t refused = 0;
  for (const auto& trial : trials) refused += trial.empty() ? 1 : 0;
  const auto nine = places();
  for (std::size_t k = 0; k < nine.size(); ++k) {
    const double predicted_m = point_error_m(covariance, master_from_scene * nine[k]);
    std::vector<double> observed;
    for (const auto& trial : trials)
      if (!trial.empty()) observed.push_back(trial[k]);
    const std::vector<double> predicted(observed.size(), predicted_m * predicted_m);
    Cell cell = rms_over_bound_cell(
        fmt::format("observed over predicted RMS error at ({:g}, {:g}) m, predicted {:.2f} mm",
                    nine[k].x(), nine[k].y(), predicted_m * 1e3),
        observed, predicted, within(1, 0.06));
    cell.judgement = options.judgement(plan_trials);
    report(cell);
  }
  report({"refused",
          static_cast<double>(refused),
          {},
          at_most(0),
          trials.size(),
          "",
          Judgement::point});
}

}  // namespace alea::acceptance
