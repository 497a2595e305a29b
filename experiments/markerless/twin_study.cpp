#include "experiments/markerless/twin_study.hpp"

#include <algorithm>
#include <numbers>

#include "alea/cloud/neighbours.hpp"
#include "alea/cloud/sampling.hpp"
#include "alea/pipeline/register_by_paper.hpp"
#include "alea/simulate/scanner.hpp"

namespace alea::experiments::markerless {
namespace {

double share_within(const Cloud& fixed, const Cloud& moving, const RigidTransform& pose) {
  const NeighbourIndex index(fixed.positions);
  std::size_t near = 0;
  for (const Eigen::Vector3d& p : moving.positions)
    if (index.nearest_one(pose * p, 0.1)) ++near;
  return static_cast<double>(near) / static_cast<double>(moving.size());
}

}  // namespace

TwinScans scan_twin(const Scene& scene, const std::vector<std::size_t>& stations,
                    std::uint64_t seed) {
  TwinScans scans;
  for (std::size_t s = 0; s < scene.stations.size(); ++s) {
    if (!stations.empty() && std::find(stations.begin(), stations.end(), s) == stations.end())
      continue;
    const Station& station = scene.stations[s];
    Cloud cloud = simulate_scan(scene, station, {seed, 6, 0, static_cast<std::uint32_t>(s)});
    scans.names.push_back(station.name);
    scans.clouds.push_back(std::move(cloud));
    scans.scene_from_scan.push_back(station.scene_from_scan);
  }
  return scans;
}

PoseError pose_error(const RigidTransform& estimate, const RigidTransform& truth) {
  return {
      rotation_angle_rad(estimate.rotation.transpose() * truth.rotation) * 180 / std::numbers::pi,
      (estimate.translation - truth.translation).norm()};
}

double rmse_at(const Cloud& fixed, const Cloud& moving, const RigidTransform& fixed_from_moving,
               const PaperIcpOptions& options) {
  IcpOptions icp_options;
  icp_options.objective = IcpObjective::point_to_point;
  icp_options.max_iterations = 0;
  const PaperScan target = prepare_paper_scan(fixed, options, false);
  const PaperScan source = prepare_paper_scan(moving, options, false);
  return icp(target.registered(), source.registered(), fixed_from_moving, icp_options).rmse_m;
}

std::vector<PaperTrial> run_paper(const TwinScans& scans, std::size_t reference,
                                  const PaperIcpOptions& options,
                                  const ProgressCallback& progress) {
  std::vector<PaperTrial> trials;
  const std::size_t all = 2 * (scans.clouds.size() - 1);
  MarkerlessOptions markerless;
  markerless.method = MarkerlessMethod::paper;
  markerless.paper = options;
  for (const bool forward : {true, false})
    for (std::size_t other = 0; other < scans.clouds.size(); ++other) {
      if (other == reference) continue;
      const std::size_t f = forward ? reference : other, m = forward ? other : reference;
      const Cloud &fixed = scans.clouds[f], &moving = scans.clouds[m];
      const MarkerlessRegistration found = register_markerless(fixed, moving, markerless);
      PaperTrial trial;
      trial.fixed = scans.names[f];
      trial.moving = scans.names[m];
      trial.truth = scans.truth(f, m);
      trial.estimate = *found.registration.master_from_slave;
      trial.error = pose_error(trial.estimate, trial.truth);
      trial.rmse_m = found.report.rmse_m;
      trial.rmse_at_truth_m = rmse_at(fixed, moving, trial.truth, options);
      trial.overlap = found.report.overlap_moving;
      trial.overlap_at_truth =
          share_within(grid_average(fixed, 0.05), grid_average(moving, 0.05), trial.truth);
      trial.iterations = found.report.iterations;
      trial.time_s = found.registration.timing_s.back().second;
      trials.push_back(trial);
      if (progress) progress("pairs of the twin", trials.size(), all);
    }
  return trials;
}

}  // namespace alea::experiments::markerless
