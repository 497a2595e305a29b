#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "alea/die/adjustment.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/pipeline/die_joint.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/efficiency_trial.hpp"
#include "experiments/engine/sample_mean.hpp"
#include "experiments/engine/wilson.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::EfficiencyCase;
using experiments::die::observe_pair;
using experiments::die::ObservedPair;

constexpr std::uint64_t own_faulty = 500, own_clean = 1000;

enum class PlantedFault { none, leaning, shifted };

/// What an adjustment is given.
struct Setting {
  const char* name;
  bool shape_known;
  bool shared_only;  ///< faults in facets that both scans see
};

/// A floor and two walls as both scans see them, with the standard deviations that a registration
/// gives its witnesses.
void add_witnesses(const ObservedPair& pair, RandomStream& stream,
                   std::vector<AdjustmentScan>& scans) {
  const Eigen::Vector3d sd(witness_tilt_sd_rad, witness_tilt_sd_rad, witness_offset_sd_m);
  const Eigen::Matrix3d covariance = sd.cwiseAbs2().asDiagonal();
  int id = 0;
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0.2, -1, 0)}) {
    ++id;
    const Eigen::Vector3d unit = normal.normalized();
    for (std::size_t s = 0; s < 2; ++s) {
      const RigidTransform scan_from_master =
          s == 0 ? RigidTransform{} : pair.master_from_slave.inverse();
      const Eigen::Vector3d centre = scan_from_master * (pair.centre_m - 3 * unit);
      const Eigen::Vector3d n = scan_from_master.rotation * unit;
      PlaneFit fit = exact_fit({n, n.dot(centre)}, centre, covariance);
      const Eigen::Vector2d lean(sd[0] * stream.normal(), sd[1] * stream.normal());
      fit.centroid_m += sd[2] * stream.normal() * n;
      fit.plane.normal = (n + fit.tangent * lean).normalized();
      fit.plane.offset_m = fit.plane.normal.dot(fit.centroid_m);
      fit.tangent = tangent_basis(fit.plane.normal);
      scans[s].planes.push_back({id, fit});
    }
  }
}

/// Another box's side: turned by 2 deg about its centre, or 1 cm in front.
void spoil(PlaneFit& fit, PlantedFault fault, double azimuth) {
  if (fault == PlantedFault::shifted) fit.centroid_m += 0.01 * fit.plane.normal;
  if (fault == PlantedFault::leaning)
    fit.plane.normal =
        (fit.plane.normal +
         std::tan(2 * deg) * fit.tangent * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)))
            .normalized();
  fit.plane.offset_m = fit.plane.normal.dot(fit.centroid_m);
  fit.tangent = tangent_basis(fit.plane.normal);
}

/// Whether the planted facet was flagged, or any where none was planted.
bool flagged(const Setting& setting, PlantedFault fault, std::uint64_t seed, std::uint64_t trial) {
  const EfficiencyCase geometry;
  const ObservedPair pair = observe_pair(geometry, seed, trial);
  const auto shared = shared_pips(pair.master, pair.slave);
  std::vector<AdjustmentScan> scans{{pair.master, {}}, {pair.slave, {}}};
  RandomStream stream({seed, 31, trial, 0, Purpose::experiment});
  add_witnesses(pair, stream, scans);
  const auto scan = static_cast<std::size_t>(stream.below(2));
  ObservedFacet* wrong = &scans[scan].die.facets[stream.below(3)];
  if (setting.shared_only)
    for (ObservedFacet& facet : scans[scan].die.facets)
      if (facet.pips == shared.at(stream.below(2))) wrong = &facet;
  if (fault != PlantedFault::none)
    spoil(wrong->fit, fault, 2 * std::numbers::pi * stream.uniform());
  AdjustmentOptions options;
  if (setting.shape_known) {
    options.shape = exact_shape(pair.shape);
  } else {
    options.shape = free_shape(cube(geometry.edge_m, Chirality::clockwise));
    options.edges = {{{shared.at(0), shared.at(1)}, pair.shared_edge_m, 0}};
  }
  const auto found = adjust_die(scans, options);
  if (!found) return false;
  for (const FacetTest& test : found->tests) {
    if (!test.suspect || test.pips == 0) continue;
    if (fault == PlantedFault::none || (test.scan == scan && test.pips == wrong->pips)) return true;
  }
  return false;
}

void report_share(const Setting& setting, PlantedFault fault, const Options& options,
                  const Report& report) {
  const bool clean = fault == PlantedFault::none;
  std::vector<double> hits(options.trials_or(clean ? own_clean : own_faulty));
  parallel_chunks(hits.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      hits[t] = flagged(setting, fault, options.seed, t) ? 1 : 0;
  });
  const char* what = clean                            ? "false flags"
                     : fault == PlantedFault::leaning ? "a facet 2 deg off is flagged"
                                                      : "a facet 1 cm off is flagged";
  Cell cell = mean_cell(fmt::format("{}: {}", setting.name, what), hits,
                        clean ? at_most(0.01) : at_least(0.95));
  const auto n = static_cast<double>(hits.size());
  cell.interval = wilson_interval(cell.value, n, 1.96);
  cell.judgement = Judgement::point;  // the line states its own n
  report(cell);
}

}  // namespace

void run_suspects(const Options& options, const Report& report) {
  for (const Setting& setting :
       std::array<Setting, 2>{{{"shape known, any facet", true, false},
                               {"shape free, a facet that both scans see", false, true}}})
    for (const PlantedFault fault :
         {PlantedFault::leaning, PlantedFault::shifted, PlantedFault::none})
      report_share(setting, fault, options, report);
}

}  // namespace alea::acceptance
