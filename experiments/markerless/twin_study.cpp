#include "experiments/markerless/twin_study.hpp"

#include <algorithm>
#include <numbers>

#include "alea/cloud/neighbours.hpp"
#include "alea/pipeline/stopwatch.hpp"
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
  return rmse_at(prepare_paper_scan(fixed, options, false),
                 prepare_paper_scan(moving, options, false), fixed_from_moving);
}

double rmse_at(const PaperScan& fixed, const PaperScan& moving,
               const RigidTransform& fixed_from_moving) {
  IcpOptions options;
  options.objective = IcpObjective::point_to_point;
  options.max_iterations = 0;
  return icp(fixed.registered(), moving.registered(), fixed_from_moving, options).rmse_m;
}

std::vector<ScanPair> reference_pairs(std::size_t scans, std::size_t reference) {
  std::vector<ScanPair> pairs;
  for (const bool forward : {true, false})
    for (std::size_t other = 0; other < scans; ++other)
      if (other != reference)
        pairs.push_back(forward ? ScanPair{reference, other} : ScanPair{other, reference});
  return pairs;
}

std::vector<ScanPair> all_pairs(std::size_t scans) {
  std::vector<ScanPair> pairs;
  for (std::size_t fixed = 0; fixed < scans; ++fixed)
    for (std::size_t moving = 0; moving < scans; ++moving)
      if (fixed != moving) pairs.push_back({fixed, moving});
  return pairs;
}

std::vector<PaperTrial> run_paper(const TwinScans& scans, const std::vector<ScanPair>& pairs,
                                  const PaperIcpOptions& options,
                                  const ProgressCallback& progress) {
  MarkerlessOptions markerless;
  markerless.method = MarkerlessMethod::paper;
  markerless.paper = options;
  std::vector<PaperScan> prepared;
  std::vector<double> sampling_s;
  Stopwatch stopwatch;
  for (const Cloud& cloud : scans.clouds) {
    prepared.push_back(prepare_paper_scan(cloud, options, true));
    sampling_s.push_back(stopwatch.lap_s());
  }
  std::vector<PaperTrial> trials;
  std::size_t done = 0;
  for (const auto& [f, m] : pairs) {
    stopwatch.lap_s();
    const MarkerlessRegistration found = register_paper_scans(prepared[f], prepared[m], markerless);
    const double icp_s = stopwatch.lap_s();
    if (progress) progress("pairs by the paper's method", ++done, pairs.size());
    if (found.registration.refusal) continue;
    PaperTrial trial;
    trial.fixed = scans.names[f];
    trial.moving = scans.names[m];
    trial.truth = scans.truth(f, m);
    trial.estimate = *found.registration.master_from_slave;
    trial.error = pose_error(trial.estimate, trial.truth);
    trial.rmse_m = found.report.rmse_m;
    trial.rmse_at_truth_m = rmse_at(prepared[f], prepared[m], trial.truth);
    trial.overlap = found.report.overlap_moving;
    trial.overlap_at_truth = share_within(prepared[f].grid, prepared[m].grid, trial.truth);
    trial.iterations = found.report.iterations;
    trial.points_moving = prepared[m].registered().size();
    trial.time_s = sampling_s[f] + sampling_s[m] + icp_s;
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace alea::experiments::markerless
