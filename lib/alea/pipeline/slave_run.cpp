#include "alea/pipeline/slave_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alea/cloud/canonical_order.hpp"
#include "alea/core/parallel.hpp"
#include "alea/pipeline/check_plane_roles.hpp"
#include "alea/pipeline/die_calibration.hpp"
#include "alea/pipeline/die_report.hpp"
#include "alea/pipeline/refinement.hpp"
#include "alea/pipeline/stopwatch.hpp"

namespace alea {
namespace {

constexpr double coarse_step_m = 0.002;  // rounding that a user should know of

/// The only die of both scans, for a pair that does not determine a transform by itself.
std::optional<DiePair> only_pair(const ScanSighting& master, const ScanSighting& slave) {
  if (master.dice.size() != 1 || slave.dice.size() != 1) return std::nullopt;
  return DiePair{master.dice[0], slave.dice[0], {}};
}

/// The fine registration that was asked for, on the calibration planes; a warning where they cannot
/// carry one.
void refine(const Cloud& master, const Cloud& slave, const SlaveRun& run,
            const DieRegistrationOptions& options, Registration& out) {
  if (options.refine == Refinement::none) return;
  const std::vector<CommonPlane> calibration =
      planes_with_role(run.planes, run.roles, CheckPlaneRole::calibration);
  const Result<RefinedTransform> refined = refine_registration(
      options.refine, master, slave, calibration, *out.master_from_slave, run.transform.centre_m);
  if (!refined) {
    out.warnings.push_back("not_refined: " + refined.refusal().message);
    return;
  }
  out.master_from_slave = refined->master_from_slave;
  if (out.covariance) out.covariance = moved_to(refined->covariance, out.covariance->about_m);
  out.refinement = refined->report;
}

std::vector<OrientationReport> reported(const std::vector<DieOrientation>& orientations) {
  std::vector<OrientationReport> out;
  for (const DieOrientation& each : orientations)
    out.push_back({each.master_from_slave, each.margin, each.scene_points});
  return out;
}

AmbiguityReport ambiguity_of(const DiePair& pair) {
  return {0, std::min(pair.master.reading.margin, pair.slave.reading.margin),
          pair.resolved_by_scene, reported(pair.orientations)};
}

const DieSighting* best_sighting(const ScanSighting& scan) {
  if (!scan.dice.empty()) return &scan.dice[0];
  return scan.ambiguous.empty() ? nullptr : &scan.ambiguous[0];
}

}  // namespace

std::optional<Refusal> sighting_refusal(const ScanSighting& master, const ScanSighting& slave) {
  const auto wrong_hand = [](const ScanSighting& scan) {
    return scan.refusal && scan.refusal->code == RefusalCode::chirality;
  };
  if (wrong_hand(master) != wrong_hand(slave) && (!master.refusal || !slave.refusal))
    return Refusal{RefusalCode::mirrored,
                   "the die is of the other hand in one of the scans; is that scan mirrored?"};
  if (master.refusal) return Refusal{master.refusal->code, "master: " + master.refusal->message};
  if (slave.refusal) return Refusal{slave.refusal->code, "slave: " + slave.refusal->message};
  return std::nullopt;
}

std::optional<AmbiguityReport> open_orientations(const ScanSighting& master,
                                                 const ScanSighting& slave, bool levelled) {
  const DieSighting *a = best_sighting(master), *b = best_sighting(slave);
  if (a == nullptr || b == nullptr) return std::nullopt;
  const std::vector<DieOrientation> all = die_orientations(*a, *b, levelled);
  const std::size_t supported = supported_orientations(all);
  if (supported < 2) return std::nullopt;
  return AmbiguityReport{static_cast<int>(supported) - 1,
                         std::min(a->reading.margin, b->reading.margin), false, reported(all)};
}

void add_sighting_notes(const ScanSighting& master, const ScanSighting& slave, Registration& out) {
  for (const auto& [scan, name] : {std::pair(&master, "master"), std::pair(&slave, "slave")}) {
    if (scan->coordinate_step_m >= coarse_step_m)
      out.warnings.push_back(fmt::format(
          "coarse_coordinates: {}: coordinates are multiples of {:g} mm; export the scan in double "
          "precision or with more decimals, about its own origin",
          name, 1e3 * scan->coordinate_step_m));
    if (scan->duplicates > 0)
      out.warnings.push_back(
          fmt::format("duplicate_points: {}: {} points repeat another one and count once", name,
                      scan->duplicates));
    if (!scan->scanner_position_known)
      out.warnings.push_back(fmt::format(
          "scanner_position_unknown: {}: facets were fitted orthogonally; give --{}-origin "
          "X,Y,Z for fits along the ray",
          name, name));
  }
  out.timing_s.emplace_back("planes", std::max(master.planes_s, slave.planes_s));
  out.timing_s.emplace_back("facets", std::max(master.facets_s, slave.facets_s));
  out.timing_s.emplace_back("pips", std::max(master.pips_s, slave.pips_s));
}

std::vector<Observed> observe_all(const Cloud& master, std::span<const Cloud> slaves,
                                  const DieRegistrationOptions& options) {
  std::vector<Observed> observed(slaves.size() + 1);
  parallel_chunks(observed.size(), 1, [&](std::size_t s, std::size_t) {
    const Cloud& scan = s == 0 ? master : slaves[s - 1];
    observed[s].cloud = without_duplicates(canonical_order(scan));
    observed[s].sighting =
        observe_die(observed[s].cloud, options, s == 0 ? options.near_m : std::nullopt);
    observed[s].sighting.duplicates = scan.size() - observed[s].cloud.size();
  });
  return observed;
}

void choose_pair(const Observed& master, const Observed& slave, bool has_others,
                 const DieRegistrationOptions& options, SlaveRun& run) {
  Result<DiePair> chosen =
      choose_die_pair(master.cloud, master.sighting, slave.cloud, slave.sighting, options);
  if (chosen) {
    run.pair = *std::move(chosen);
    run.transform = run.pair->transform;
    return;
  }
  run.refusal = chosen.refusal();
  const bool open = run.refusal->code == RefusalCode::one_shared_facet ||
                    run.refusal->code == RefusalCode::unobservable;
  if (!open || !has_others || options.method != DieMethod::adjustment) return;
  run.pair = only_pair(master.sighting, slave.sighting);
  run.tied_by_others = run.pair.has_value();
}

void agree_on_one_die(const std::vector<Observed>& observed, const DieRegistrationOptions& options,
                      std::vector<SlaveRun>& runs) {
  const auto first = std::find_if(runs.begin(), runs.end(), [](const SlaveRun& run) {
    return run.pair && !run.tied_by_others;
  });
  if (first == runs.end()) return;
  Observed master = observed[0];
  master.sighting.dice = {first->pair->master};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r].pair || runs[r].pair->master.regions == first->pair->master.regions) continue;
    runs[r] = {};
    choose_pair(master, observed[r + 1], runs.size() > 1, options, runs[r]);
  }
}

void find_planes(const Observed& master, const Observed& slave,
                 const DieRegistrationOptions& options, SlaveRun& run) {
  run.planes = find_common_planes(
      master.cloud, scene_planes(master.sighting.planes, run.pair->master), slave.cloud,
      scene_planes(slave.sighting.planes, run.pair->slave), run.transform.master_from_slave);
  run.roles = plane_roles(run.planes, options);
}

void calibrate(const Observed& master, const Observed& slave, const DieRegistrationOptions& options,
               SlaveRun& run) {
  const Result<DieTransform> transform =
      calibrate_die(master.cloud, slave.cloud, *run.pair, run.planes, run.roles, options);
  if (!transform) {
    run.refusal = transform.refusal();
    run.pair.reset();
    return;
  }
  run.transform = *transform;
}

void conclude(const Observed& master, const Observed& slave, const DieRegistrationOptions& options,
              SlaveRun& run, Registration& out) {
  Stopwatch watch;
  if (run.tied_by_others) find_planes(master, slave, options, run);
  const DieTransform& transform = run.transform;
  const DiePair& pair = *run.pair;
  out.master_from_slave = transform.master_from_slave;
  out.covariance = transform.covariance;
  out.adjustment = run.adjustment;
  out.die =
      die_report(pair, transform, options.calibrate && transform.lengths_m.size() > 0, options);
  out.ambiguity = ambiguity_of(pair);
  for (const std::string& warning : transform.warnings) out.warnings.push_back(warning);
  if (pair.resolved_by_scene)
    out.warnings.push_back(
        "resolved_by_scene: the pips left several orientations of the die; the rest of the scene "
        "chose one, and the pips named here are as likely as those of another orientation");
  for (std::string& warning : size_warnings(pair, options))
    out.warnings.push_back(std::move(warning));
  refine(master.cloud, slave.cloud, run, options, out);
  out.check_planes.resize(run.planes.size());
  parallel_chunks(run.planes.size(), 1, [&](std::size_t i, std::size_t) {
    out.check_planes[i] =
        evaluate_check_plane(master.cloud, slave.cloud, run.planes[i], *out.master_from_slave);
    out.check_planes[i].role = run.roles[i];
  });
  out.timing_s.emplace_back("evaluation", watch.lap_s());
}

}  // namespace alea
