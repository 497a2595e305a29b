#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// What a plan takes for granted beyond the scene itself.
struct PlanAssumptions {
  bool shape_known = false;  ///< bound K; else L: tilts and offsets free, shared edges known
  double edge_sd_m = 0;      ///< of each shared edge; 0: exact
  double level_sd_rad = unknown_sd;  ///< of both axes of every scanner; unknown_sd: not levelled
  /// Only the part of each facet that `register die` fits: borders of the edge radius, the
  /// footprint or 1 cm, and the pips, left out. Else the whole facets: the bound.
  bool fitted_facets = false;
  bool jointly = true;  ///< all stations in one adjustment; else each slave with the master alone
  bool dice = true, spheres = true, planes = true;  ///< targets that count (patches: role
                                                    ///< calibration)
  bool within_windows = true;  ///< a station sees its own window of angles only
};

/// The scene of a bound: every target with what each station sees of it past the other objects,
/// with that station's own noise and step. Throws Error(usage) without two stations or a target.
FisherScene planned_scene(const Scene& scene, const PlanAssumptions& assumptions);

/// What one station will have of one facet of the first die.
struct PlannedFacet {
  std::size_t station = 0;
  int pips = 0;
  double points = 0;         ///< expected
  double incidence_rad = 0;  ///< at the facet's centre
};
std::vector<PlannedFacet> planned_facets(const Scene& scene, const PlanAssumptions& assumptions);

/// Where accuracies are quoted: the centre of the first die, else the mean of the targets (m, scene
/// frame).
Eigen::Vector3d target_centre_m(const Scene& scene, const PlanAssumptions& assumptions);

/// A slave station and the predicted covariance of master_from_slave about the target's centre, in
/// the frame of the master, which is station 0. Refused as `unobservable` where it stays open.
struct PlannedPair {
  std::size_t slave = 1;
  Result<TransformCovariance> covariance;
};
std::vector<PlannedPair> plan_pairs(const Scene& scene, const PlanAssumptions& assumptions);

/// The farther of a pair's distances from the die's centre (m) up to which the RMS error on a
/// horizontal ring about the die stays within a tolerance, both stations moved along their lines of
/// azimuth at their own heights in free field. Empty without a die, or where even the nearest
/// distance tried (the die's size away) is not enough; at most 200 m.
struct ReachCase {
  std::size_t slave = 1;
  double tolerance_m = 0.0025;
  double ring_m = 10;
};
std::optional<double> reach_m(const Scene& scene, const PlanAssumptions& assumptions,
                              const ReachCase& reach);

}  // namespace alea
