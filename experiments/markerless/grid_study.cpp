#include "experiments/markerless/grid_study.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "alea/core/seed.hpp"
#include "alea/pipeline/register_by_paper.hpp"

namespace alea::experiments::markerless {
namespace {

/// The truth turned by 3 deg about the vertical and shifted by 0.23 m level: the scanners are
/// levelled and stand on the ground.
RigidTransform near_truth(const RigidTransform& truth, std::uint64_t seed, int draw) {
  RandomStream stream({seed, 6, static_cast<std::uint64_t>(draw), 7, Purpose::experiment});
  const double turn = (stream.uniform() < 0.5 ? -3 : 3) * std::numbers::pi / 180;
  const double towards = 2 * std::numbers::pi * stream.uniform();
  RigidTransform step;
  step.rotation = rotation_exp({0, 0, turn});
  RigidTransform start = truth * step;
  start.translation += 0.23 * Eigen::Vector3d(std::cos(towards), std::sin(towards), 0);
  return start;
}

void add_paper(const TwinScans& scans, double cell_m, const GridStudyOptions& options,
               std::vector<GridTrial>& trials) {
  MarkerlessOptions markerless;
  markerless.method = MarkerlessMethod::paper;
  markerless.paper.cell_m = cell_m;
  const std::array<PaperScan, 2> prepared{
      prepare_paper_scan(scans.clouds[0], markerless.paper, true),
      prepare_paper_scan(scans.clouds[1], markerless.paper, true)};
  for (const ScanPair& pair : all_pairs(2)) {
    const RigidTransform truth = scans.truth(pair.fixed, pair.moving);
    const PaperScan &fixed = prepared[pair.fixed], &moving = prepared[pair.moving];
    GridTrial trial;
    trial.cell_m = cell_m;
    trial.points = moving.registered().size();
    trial.rmse_at_truth_m = rmse_at(fixed, moving, truth);
    for (int draw = -1; draw < options.draws; ++draw) {
      markerless.initial.reset();
      if (draw >= 0) markerless.initial = near_truth(truth, options.seed, draw);
      const MarkerlessRegistration found = register_paper_scans(fixed, moving, markerless);
      trial.start = draw < 0 ? GridStart::identity : GridStart::near_truth;
      trial.rmse_m = found.report.rmse_m;
      trial.error = pose_error(*found.registration.master_from_slave, truth);
      trials.push_back(trial);
    }
  }
}

void add_robust(const TwinScans& scans, double cell_m, const GridStudyOptions& options,
                std::vector<GridTrial>& trials) {
  PrepareOptions prepare;
  prepare.cell_m = cell_m;
  const std::array<PreparedScan, 2> prepared{prepare_scan(scans.clouds[0], prepare),
                                             prepare_scan(scans.clouds[1], prepare)};
  MarkerlessOptions markerless;
  markerless.seed = options.seed;
  for (const ScanPair& pair : all_pairs(2)) {
    const auto found = register_prepared(prepared[pair.fixed], prepared[pair.moving], markerless);
    if (!found.report.best) continue;
    GridTrial trial;
    trial.cell_m = cell_m;
    trial.start = GridStart::robust;
    trial.points = prepared[pair.moving].fine.size();
    trial.rmse_m = found.report.rmse_m;
    trial.error = pose_error(*found.report.best, scans.truth(pair.fixed, pair.moving));
    trials.push_back(trial);
  }
}

}  // namespace

std::vector<GridTrial> run_grids(const TwinScans& scans, const GridStudyOptions& options,
                                 const ProgressCallback& progress) {
  std::vector<GridTrial> trials;
  const std::size_t all = options.cells_m.size() + options.robust_cells_m.size();
  std::size_t done = 0;
  for (const double cell_m : options.cells_m) {
    add_paper(scans, cell_m, options, trials);
    if (progress) progress("grids", ++done, all);
  }
  for (const double cell_m : options.robust_cells_m) {
    add_robust(scans, cell_m, options, trials);
    if (progress) progress("grids", ++done, all);
  }
  return trials;
}

}  // namespace alea::experiments::markerless
