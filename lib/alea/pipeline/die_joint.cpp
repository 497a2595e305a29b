#include "alea/pipeline/die_joint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "alea/core/angle.hpp"
#include "alea/die/adjustment.hpp"
#include "alea/die/assembly.hpp"
#include "alea/pipeline/joint_shape.hpp"

namespace alea {
namespace {

constexpr std::size_t most_witnesses = 60;  // in all: each costs three unknowns

/// The scans of an adjustment and which run each slave belongs to.
struct JointScans {
  std::vector<AdjustmentScan> scans;  ///< the master first
  std::vector<std::size_t> run_of;    ///< of scans[i + 1]
};

JointScans scans_of(const std::vector<SlaveRun>& runs) {
  JointScans out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r].pair) continue;
    if (out.scans.empty()) out.scans.push_back({runs[r].pair->master.die, {}});
    out.scans.push_back({runs[r].pair->slave.die, {}});
    out.run_of.push_back(r);
  }
  return out;
}

PlaneFit loosened(PlaneFit fit) {
  const Eigen::Vector3d sd(witness_tilt_sd_rad, witness_tilt_sd_rad, witness_offset_sd_m);
  fit.covariance.diagonal() += sd.cwiseAbs2();
  return fit;
}

/// Adds the common planes that `take` accepts to the master and to their slaves.
template <typename Take>
void add_planes(const std::vector<SlaveRun>& runs, JointScans& joint, bool as_witness, Take take) {
  int id = 0;
  for (std::size_t s = 0; s < joint.run_of.size(); ++s) {
    const SlaveRun& run = runs[joint.run_of[s]];
    for (std::size_t p = 0; p < run.planes.size(); ++p) {
      if (!take(run, p)) continue;
      ++id;
      const CommonPlane& plane = run.planes[p];
      joint.scans[0].planes.push_back(
          {id, as_witness ? loosened(plane.fit_master) : plane.fit_master});
      joint.scans[s + 1].planes.push_back(
          {id, as_witness ? loosened(plane.fit_slave) : plane.fit_slave});
    }
  }
}

void drop_plane(JointScans& joint, int id) {
  for (AdjustmentScan& scan : joint.scans)
    std::erase_if(scan.planes, [&](const ScenePlane& plane) { return plane.id == id; });
}

/// What the scene's planes say of the facets and of the lengths that were given.
struct Witnesses {
  std::vector<FacetTest> tests;
  std::vector<std::string> warnings;
};

/// A length that the user gave is itself on trial: held exact, a wrong one would make the planes
/// accuse the facets.
AdjustmentOptions with_doubtful_edges(AdjustmentOptions options) {
  constexpr double doubt = 0.15;  // of the length: further off the size is refused
  for (KnownEdge& edge : options.edges) edge.sd_m = std::max(edge.sd_m, doubt * edge.length_m);
  return options;
}

/// Given lengths that the planes contradict by more than three standard deviations.
std::vector<std::string> doubtful_edges(const std::vector<KnownEdge>& given,
                                        const DieAdjustment& witnessed) {
  std::vector<std::string> warnings;
  for (const KnownEdge& edge : given)
    for (const AdjustedEdge& seen : witnessed.edges) {
      const bool same = seen.edge.first_pips == edge.edge.first_pips &&
                        seen.edge.second_pips == edge.edge.second_pips;
      if (!same || !seen.length_m || !seen.sd_m) continue;
      const double difference_m = *seen.length_m - edge.length_m;
      if (std::abs(difference_m) <= 3 * std::hypot(*seen.sd_m, edge.sd_m)) continue;
      warnings.push_back(
          fmt::format("edge_unverified: the planes that the scans share make edge {} {:.4f} m long "
                      "(sd {:.4f}), "
                      "{:+.1f} mm from the given {:.4f} m; measure it or use --calibrate",
                      edge_name(edge.edge.first_pips, edge.edge.second_pips), *seen.length_m,
                      *seen.sd_m, difference_m * 1e3, edge.length_m));
    }
  return warnings;
}

/// The tests of the facets and of the given lengths with the scene's planes as witnesses. A plane
/// that is clearly stranger than any facet is itself no witness: it is left out and the tests are
/// made again.
Witnesses hear_witnesses(const std::vector<SlaveRun>& runs, JointScans joint,
                         const AdjustmentOptions& given, std::vector<FacetTest> alone) {
  const AdjustmentOptions options = with_doubtful_edges(given);
  for (AdjustmentScan& scan : joint.scans) scan.planes.clear();
  const std::size_t share = most_witnesses / std::max<std::size_t>(1, joint.run_of.size());
  add_planes(runs, joint, true, [&](const SlaveRun&, std::size_t p) { return p < share; });
  while (!joint.scans[0].planes.empty()) {
    const auto adjusted = adjust_die(joint.scans, options);
    if (!adjusted) break;
    // Facets come first in the tests, so the first suspect is a plane only where no facet is one.
    const auto first = std::find_if(adjusted->tests.begin(), adjusted->tests.end(),
                                    [](const FacetTest& test) { return test.suspect; });
    if (first == adjusted->tests.end() || first->pips > 0)
      return {adjusted->tests, doubtful_edges(given.edges, *adjusted)};
    drop_plane(joint, first->plane);
  }
  return {std::move(alone), {}};
}

std::string scan_name(std::size_t scan, std::size_t slaves) {
  if (scan == 0) return "the master";
  return slaves == 1 ? "the slave" : fmt::format("slave {}", scan);
}

std::optional<std::string> suspect_warning(const AdjustmentReport& report, std::size_t slaves) {
  std::string names;
  const FacetTest* first = nullptr;
  for (const FacetTest& test : report.tests) {
    if (!test.suspect || test.pips == 0) continue;
    if (first == nullptr) first = &test;
    names += fmt::format("{}facet {} of {}", names.empty() ? "" : " or ", test.pips,
                         scan_name(test.scan, slaves));
  }
  if (first == nullptr) return std::nullopt;
  return fmt::format(
      "facet_suspect: {} does not belong to this die: {:.3f} deg and {:.2f} mm off what the other "
      "facets say (chi-square {:.1f} on {}); is it another box's side?",
      names, first->residual.head<2>().norm() * deg_per_rad, std::abs(first->residual[2]) * 1e3,
      first->statistic, first->freedom);
}

AdjustmentReport report_of(const DieAdjustment& adjusted, const JointScans& joint,
                           std::vector<FacetTest> tests) {
  AdjustmentReport report;
  report.scans = joint.scans.size();
  report.chi_square = adjusted.chi_square;
  report.freedom = adjusted.freedom;
  report.p_value = adjusted.p_value;
  report.covariance_factor = adjusted.covariance_factor;
  report.defect = adjusted.defect;
  report.open = adjusted.open;
  report.components = adjusted.components;
  report.tests = std::move(tests);
  report.iterations = adjusted.iterations;
  std::erase_if(report.tests, [](const FacetTest& test) { return test.pips == 0; });
  // Scans are numbered as given, not as they took part.
  const auto given = [&](std::size_t scan) { return scan == 0 ? 0 : joint.run_of[scan - 1] + 1; };
  for (FacetTest& test : report.tests) test.scan = given(test.scan);
  for (VarianceComponent& component : report.components)
    if (component.scan) component.scan = given(*component.scan);
  return report;
}

std::vector<std::string> warnings_of(const AdjustmentReport& report, std::size_t slaves) {
  std::vector<std::string> warnings;
  if (report.covariance_factor > 1)
    warnings.push_back(fmt::format(
        "shape_disagreement: the scans disagree about the shape that they see (chi-square {:.1f} "
        "on {} degrees of freedom; the covariance is multiplied by {:.1f}); was the die moved or "
        "bent between the scans?",
        report.chi_square, report.freedom, report.covariance_factor));
  if (auto suspect = suspect_warning(report, slaves)) warnings.push_back(std::move(*suspect));
  return warnings;
}

void take_over(const DieAdjustment& adjusted, const AdjustedPose& pose, SlaveRun& run) {
  run.refusal.reset();
  run.transform.master_from_slave = pose.master_from_scan;
  run.transform.covariance = pose.covariance;
  for (const AdjustedEdge& edge : adjusted.edges)
    if (edge.length_m)
      run.transform.edges_m[edge_name(edge.edge.first_pips, edge.edge.second_pips)] =
          *edge.length_m;
  run.transform.corner_master_m = assemble_corner(planes_of(run.pair->master.die))->corner_m;
  run.transform.corner_slave_m = assemble_corner(planes_of(run.pair->slave.die))->corner_m;
}

}  // namespace

void adjust_together(std::vector<SlaveRun>& runs, const DieRegistrationOptions& options) {
  JointScans joint = scans_of(runs);
  if (joint.scans.empty()) return;
  if (options.join_planes)
    add_planes(runs, joint, false, [](const SlaveRun& run, std::size_t p) {
      return run.roles[p] == CheckPlaneRole::calibration;
    });
  const auto all_determined = [](const DieAdjustment& adjusted) {
    return std::all_of(adjusted.poses.begin(), adjusted.poses.end(),
                       [](const AdjustedPose& pose) { return pose.determined; });
  };
  AdjustmentOptions adjustment = joint_options(runs, options, false);
  auto adjusted = adjust_die(joint.scans, adjustment);
  if (adjusted && !all_determined(*adjusted) && options.tilt_prior_rad) {
    adjustment = joint_options(runs, options, true);
    adjusted = adjust_die(joint.scans, adjustment);
  }
  if (!adjusted) {
    for (const std::size_t r : joint.run_of) runs[r].refusal = adjusted.refusal();
    return;
  }
  const Witnesses witnesses = hear_witnesses(runs, joint, adjustment, adjusted->tests);
  const AdjustmentReport report = report_of(*adjusted, joint, witnesses.tests);
  for (std::size_t s = 0; s < joint.run_of.size(); ++s) {
    SlaveRun& run = runs[joint.run_of[s]];
    run.adjustment = report;
    const AdjustedPose& pose = adjusted->poses[s + 1];
    if (pose.determined) {
      take_over(*adjusted, pose, run);
    } else if (!run.refusal) {
      run.refusal = Refusal{RefusalCode::unobservable, report.open.front()};
    }
    for (std::string& warning : warnings_of(report, runs.size()))
      run.transform.warnings.push_back(std::move(warning));
    for (const std::string& warning : witnesses.warnings) run.transform.warnings.push_back(warning);
  }
}

}  // namespace alea
