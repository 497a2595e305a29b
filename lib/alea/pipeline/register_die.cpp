#include "alea/pipeline/register_die.hpp"

#include <fmt/format.h>

#include "alea/cloud/canonical_order.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/pipeline/check_plane_roles.hpp"
#include "alea/pipeline/die_calibration.hpp"
#include "alea/pipeline/die_pair.hpp"
#include "alea/pipeline/die_report.hpp"
#include "alea/pipeline/die_stages.hpp"
#include "alea/pipeline/observe_die.hpp"
#include "alea/pipeline/stopwatch.hpp"

namespace alea {
namespace {

void require_intensity(const Cloud& cloud, const char* scan) {
  if (!cloud.has_intensity())
    throw input_error(fmt::format(
        "{}: no intensity, so the pips cannot be read; give a scan with intensity", scan));
}

/// Why there is no die in one of the scans. A die of the other hand in one scan only is a mirrored
/// scan.
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

void add_sighting_notes(const ScanSighting& master, const ScanSighting& slave, Registration& out) {
  for (const auto& [scan, name] : {std::pair(&master, "master"), std::pair(&slave, "slave")})
    if (!scan->scanner_position_known)
      out.warnings.push_back(fmt::format(
          "scanner_position_unknown: {}: facets were fitted orthogonally; give --{}-origin "
          "X,Y,Z for fits along the ray",
          name, name));
  out.timing_s.emplace_back("planes", std::max(master.planes_s, slave.planes_s));
  out.timing_s.emplace_back("facets", std::max(master.facets_s, slave.facets_s));
  out.timing_s.emplace_back("pips", std::max(master.pips_s, slave.pips_s));
}

/// The fine registration that was asked for, on the calibration planes; a warning where they cannot
/// carry one.
void refine(const DieRegistrationOptions& options, const DieStages& stages,
            const std::vector<CheckPlaneRole>& roles, const Eigen::Vector3d& about_m,
            Registration& out) {
  if (options.refine == Refinement::none) return;
  const std::vector<CommonPlane> calibration =
      planes_with_role(stages.planes, roles, CheckPlaneRole::calibration);
  const Result<RefinedTransform> refined = refine_registration(
      options.refine, stages.master, stages.slave, calibration, *out.master_from_slave, about_m);
  if (!refined) {
    out.warnings.push_back("not_refined: " + refined.refusal().message);
    return;
  }
  out.master_from_slave = refined->master_from_slave;
  if (out.covariance) out.covariance = moved_to(refined->covariance, out.covariance->about_m);
  out.refinement = refined->report;
}

/// From the die that both scans mean to the transform and its check; empty, or why it is refused.
std::optional<Refusal> register_pair(const DieRegistrationOptions& options, DieStages& stages,
                                     Registration& out) {
  Stopwatch watch;
  const Cloud &master = stages.master, &slave = stages.slave;
  Result<DiePair> chosen =
      choose_die_pair(master, stages.of_master, slave, stages.of_slave, options);
  if (!chosen) return chosen.refusal();
  const DiePair& pair = stages.pair.emplace(*std::move(chosen));
  out.timing_s.emplace_back("transform", watch.lap_s());

  const std::vector<CommonPlane>& planes = stages.planes = find_common_planes(
      master, scene_planes(stages.of_master.planes, pair.master), slave,
      scene_planes(stages.of_slave.planes, pair.slave), pair.transform.master_from_slave);
  const std::vector<CheckPlaneRole> roles = plane_roles(planes, options);
  const Result<DieTransform> transform =
      options.calibrate ? calibrate_die(master, slave, pair, planes, roles, options)
                        : Result(pair.transform);
  if (!transform) return transform.refusal();
  out.timing_s.emplace_back("calibration", watch.lap_s());

  out.master_from_slave = transform->master_from_slave;
  out.covariance = transform->covariance;
  const bool calibrated = options.calibrate && transform->lengths_m.size() > 0;
  out.die = die_report(pair, *transform, calibrated, options);
  out.ambiguity = {std::max(pair.master.reading.alternatives, pair.slave.reading.alternatives),
                   std::min(pair.master.reading.margin, pair.slave.reading.margin)};
  out.warnings.insert(out.warnings.end(), transform->warnings.begin(), transform->warnings.end());
  for (std::string& warning : size_warnings(pair, options))
    out.warnings.push_back(std::move(warning));
  refine(options, stages, roles, transform->centre_m, out);
  out.check_planes.resize(planes.size());
  parallel_chunks(planes.size(), 1, [&](std::size_t i, std::size_t) {
    out.check_planes[i] = evaluate_check_plane(master, slave, planes[i], *out.master_from_slave);
    out.check_planes[i].role = roles[i];
  });
  out.timing_s.emplace_back("evaluation", watch.lap_s());
  return std::nullopt;
}

}  // namespace

const char* to_string(DieMethod method) {
  switch (method) {
    case DieMethod::paper:
      return "paper";
    case DieMethod::paper_literal:
      return "paper_literal";
    case DieMethod::closed_form:
      return "closed_form";
  }
  return "unknown";
}

StagedDieRegistration register_die_in_stages(const Cloud& master_scan, const Cloud& slave_scan,
                                             const DieRegistrationOptions& options) {
  require_intensity(master_scan, "master");
  require_intensity(slave_scan, "slave");
  Stopwatch total;
  StagedDieRegistration staged;
  Registration& out = staged.registration;
  DieStages& stages = staged.stages;
  out.method = to_string(options.method);
  parallel_pair(
      [&] {
        stages.master = canonical_order(master_scan);
        stages.of_master = observe_die(stages.master, options, options.near_m);
      },
      [&] {
        stages.slave = canonical_order(slave_scan);
        stages.of_slave = observe_die(stages.slave, options, std::nullopt);
      });
  add_sighting_notes(stages.of_master, stages.of_slave, out);
  out.refusal = sighting_refusal(stages.of_master, stages.of_slave);
  if (!out.refusal) out.refusal = register_pair(options, stages, out);
  out.timing_s.emplace_back("total", total.lap_s());
  return staged;
}

Registration register_die(const Cloud& master, const Cloud& slave,
                          const DieRegistrationOptions& options) {
  return register_die_in_stages(master, slave, options).registration;
}

}  // namespace alea
