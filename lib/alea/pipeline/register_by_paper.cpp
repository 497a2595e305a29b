#include "alea/pipeline/register_by_paper.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alea/cloud/normals.hpp"
#include "alea/cloud/sampling.hpp"
#include "alea/core/parallel.hpp"
#include "alea/markerless/keypoints.hpp"
#include "alea/pipeline/stopwatch.hpp"

namespace alea {
namespace {

/// Share of the moving points that have a fixed point within 0.1 m.
double overlap_at(const NeighbourIndex& fixed, const Cloud& moving, const RigidTransform& pose) {
  std::vector<std::uint8_t> near(moving.size());
  parallel_chunks(moving.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      near[i] = fixed.nearest_one(pose * moving.positions[i], 0.1).has_value();
  });
  std::size_t count = 0;
  for (const std::uint8_t one : near) count += one;
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(moving.size(), 1));
}

std::vector<Keypoint> keypoints_of(const Cloud& grid, const PaperIcpOptions& options) {
  const double radius_m = options.keypoint_radius_m;
  if (options.keypoints == PaperKeypoints::harris) {
    HarrisOptions harris;
    harris.radius_m = radius_m;
    return harris_keypoints(grid, harris);
  }
  IssOptions iss;
  iss.salient_radius_m = radius_m;
  iss.suppression_radius_m = 2 * radius_m / 3;
  return iss_keypoints(grid, iss);
}

IcpOptions icp_options_of(const PaperIcpOptions& paper) {
  IcpOptions options;
  options.objective = paper.objective;
  options.max_iterations = paper.max_iterations;
  options.rotation_tolerance_rad = paper.rotation_tolerance_rad;
  options.translation_tolerance_m = paper.translation_tolerance_m;
  options.settled_change = 0;
  return options;
}

std::optional<Refusal> too_few_keypoints(const PaperScan& fixed, const PaperScan& moving,
                                         const PaperIcpOptions& options) {
  if (!fixed.keypoints) return std::nullopt;
  const std::size_t needed = options.objective == IcpObjective::point_to_point ? 3 : 6;
  if (std::min(fixed.keypoints->size(), moving.keypoints->size()) >= needed) return std::nullopt;
  return Refusal{RefusalCode::too_few_points,
                 fmt::format("{} and {} keypoints in the fixed and the moving scan, {} are needed; "
                             "take a finer grid or a wider --keypoint-radius",
                             fixed.keypoints->size(), moving.keypoints->size(), needed)};
}

void note_keypoints(const PaperScan& fixed, const PaperScan& moving, MarkerlessReport& report) {
  if (!fixed.keypoints) return;
  report.keypoints_fixed = fixed.keypoints->size();
  report.keypoints_moving = moving.keypoints->size();
}

}  // namespace

PaperScan prepare_paper_scan(const Cloud& scan, const PaperIcpOptions& options, bool is_target) {
  PaperScan out;
  out.grid = options.cell_m > 0 ? grid_average(scan, options.cell_m) : scan;
  out.grid.normals.clear();
  const bool for_icp = is_target && options.objective == IcpObjective::point_to_plane;
  if (for_icp || options.keypoints == PaperKeypoints::harris)
    for (const Eigen::Vector3d& n : estimate_normals(out.grid, {options.normal_neighbours, {}}))
      out.grid.normals.push_back(n.cast<float>());
  if (options.keypoints == PaperKeypoints::none) return out;
  std::vector<std::uint32_t> indices;
  for (const Keypoint& keypoint : keypoints_of(out.grid, options))
    indices.push_back(keypoint.index);
  out.keypoints = subset(out.grid, indices);
  return out;
}

MarkerlessRegistration register_by_paper(const Cloud& fixed, const Cloud& moving,
                                         const MarkerlessOptions& options) {
  Stopwatch stopwatch;
  const PaperScan target = prepare_paper_scan(fixed, options.paper, true);
  const PaperScan source = prepare_paper_scan(moving, options.paper, false);
  const double sampling_s = stopwatch.lap_s();
  MarkerlessRegistration out = register_paper_scans(target, source, options);
  const double icp_s = stopwatch.lap_s();
  out.registration.timing_s = {
      {"sample", sampling_s}, {"icp", icp_s}, {"total", sampling_s + icp_s}};
  return out;
}

MarkerlessRegistration register_paper_scans(const PaperScan& fixed, const PaperScan& moving,
                                            const MarkerlessOptions& options) {
  MarkerlessRegistration out;
  out.registration.method = "paper";
  note_keypoints(fixed, moving, out.report);
  out.registration.refusal = too_few_keypoints(fixed, moving, options.paper);
  if (out.registration.refusal) return out;
  const IcpResult result =
      icp(fixed.registered(), moving.registered(), options.initial.value_or(RigidTransform{}),
          icp_options_of(options.paper));
  const RigidTransform& pose = result.target_from_source;
  out.registration.master_from_slave = pose;
  out.report.best = pose;
  out.report.rmse_m = result.rmse_m;
  out.report.iterations = result.iterations;
  out.report.overlap_moving = overlap_at(NeighbourIndex(fixed.grid.positions), moving.grid, pose);
  out.report.overlap_fixed =
      overlap_at(NeighbourIndex(moving.grid.positions), fixed.grid, pose.inverse());
  if (!result.converged())
    out.registration.warnings.push_back(
        fmt::format("no_convergence: ICP stopped by its {} after {} iterations",
                    to_string(result.stop), result.iterations));
  return out;
}

}  // namespace alea
