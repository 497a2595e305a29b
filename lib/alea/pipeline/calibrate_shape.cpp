#include "alea/pipeline/calibrate_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/pipeline/joint_shape.hpp"
#include "alea/pipeline/slave_run.hpp"

namespace alea {
namespace {

/// The scans that have the die, the first of them as the master.
struct Seen {
  std::vector<Observed> observed;
  std::vector<SlaveRun> runs;  ///< of observed[i + 1]
  std::vector<AdjustmentScan> scans;
};

Result<Seen> find_the_die(std::span<const Cloud> scans, const ShapeCalibrationOptions& options,
                          std::vector<std::string>& warnings) {
  Seen seen;
  seen.observed = observe_all(scans[0], scans.subspan(1), options.die);
  if (const auto& refusal = seen.observed[0].sighting.refusal)
    return Refusal{refusal->code, "scan 1: " + refusal->message};
  std::optional<Refusal> first_refusal;
  seen.runs.resize(scans.size() - 1);
  parallel_chunks(seen.runs.size(), 1, [&](std::size_t r, std::size_t) {
    SlaveRun& run = seen.runs[r];
    run.refusal = sighting_refusal(seen.observed[0].sighting, seen.observed[r + 1].sighting);
    if (!run.refusal) choose_pair(seen.observed[0], seen.observed[r + 1], true, options.die, run);
  });
  agree_on_one_die(seen.observed, options.die, seen.runs);
  for (std::size_t r = 0; r < seen.runs.size(); ++r) {
    const SlaveRun& run = seen.runs[r];
    if (run.pair) {
      if (seen.scans.empty()) seen.scans.push_back({run.pair->master.die, {}});
      seen.scans.push_back({run.pair->slave.die, {}});
      continue;
    }
    warnings.push_back(fmt::format("scan_left_out: scan {}: {}", r + 2, run.refusal->message));
    if (!first_refusal) first_refusal = run.refusal;
  }
  if (seen.scans.empty()) return *first_refusal;
  return seen;
}

/// Planes of the scene under the poses of a first adjustment; returns their number.
std::size_t add_planes(const DieAdjustment& poses, const ShapeCalibrationOptions& options,
                       Seen& seen) {
  int id = 0;
  std::size_t scan = 0;
  for (std::size_t r = 0; r < seen.runs.size(); ++r) {
    SlaveRun& run = seen.runs[r];
    if (!run.pair) continue;
    ++scan;
    run.transform.master_from_slave = poses.poses[scan].master_from_scan;
    find_planes(seen.observed[0], seen.observed[r + 1], options.die, run);
    for (const CommonPlane& plane : run.planes) {
      ++id;
      seen.scans[0].planes.push_back({id, plane.fit_master});
      seen.scans[scan].planes.push_back({id, plane.fit_slave});
    }
  }
  return static_cast<std::size_t>(id);
}

/// The lengths that the user or the extents support.
std::vector<KnownEdge> supported_edges(const Seen& seen, const ShapeCalibrationOptions& options) {
  std::vector<KnownEdge> edges;
  const auto add = [&](const std::string& name, double length_m, double sd_m) {
    edges.push_back({{name[0] - '0', name[2] - '0'}, length_m, sd_m});
  };
  for (const SlaveRun& run : seen.runs) {
    if (!run.pair) continue;
    for (const MeasuredEdge& edge : measured_edges(run.pair->master, run.pair->slave)) {
      const bool is_new = std::none_of(edges.begin(), edges.end(), [&](const KnownEdge& known) {
        return edge_name(known.edge.first_pips, known.edge.second_pips) == edge.name;
      });
      if (!is_new) continue;
      if (options.die.edge_sd_m)
        add(edge.name, nominal_edge_m(options.die, edge.length_m).value_or(edge.length_m),
            *options.die.edge_sd_m);
      else if (options.use_extents)
        add(edge.name, edge.length_m, edge.sd_m);
    }
  }
  return edges;
}

}  // namespace

Result<ShapeCalibration> calibrate_shape(std::span<const Cloud> scans,
                                         const ShapeCalibrationOptions& options) {
  if (scans.size() < 2) throw usage_error("calibrate die: two scans at least, from around the die");
  for (std::size_t s = 0; s < scans.size(); ++s)
    if (!scans[s].has_intensity())
      throw input_error(fmt::format(
          "scan {}: no intensity, so the pips cannot be read; give a scan with intensity", s + 1));
  ShapeCalibration out;
  Result<Seen> found = find_the_die(scans, options, out.warnings);
  if (!found) return found.refusal();
  Seen& seen = *found;
  AdjustmentOptions adjustment = joint_options(seen.runs, options.die, false);
  // With the nominal lengths the poses are good enough to find the planes that scans share.
  const auto nominal = adjust_die(seen.scans, adjustment);
  if (!nominal) return nominal.refusal();
  if (options.use_planes) out.planes = add_planes(*nominal, options, seen);
  adjustment.edges = supported_edges(seen, options);
  auto adjusted = adjust_die(seen.scans, adjustment);
  if (!adjusted) return adjusted.refusal();
  out.adjusted = *std::move(adjusted);
  out.hand = hand_of(seen.scans[0].die).value_or(Chirality::clockwise);
  out.scans = seen.scans.size();
  for (const FacetTest& test : out.adjusted.tests)
    if (test.suspect && test.pips > 0)
      out.warnings.push_back(
          fmt::format("facet_suspect: facet {} of one scan does not belong to this die (chi-square "
                      "{:.1f} on {})",
                      test.pips, test.statistic, test.freedom));
  return out;
}

}  // namespace alea
