#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/rigid_transform.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/observed_die.hpp"
#include "alea/facet/plane_fit.hpp"

namespace alea::experiments::die {

/// A cube with tilted facets, seen by two stations a quarter turn apart in the geometry of the
/// bound (alea::DieBoundCase): scans of the die alone, point by point.
struct EfficiencyCase {
  double edge_m = 0.5;
  double range_m = 6;
  double step_rad = 1e-3;
  double tilt_sd_rad = 0.00698;  ///< 0.4 deg, each facet, two directions
  FitMethod fit = FitMethod::along_ray;
  // What no noise model knows of.
  double bow_m = 0;            ///< of every facet, outward
  double edge_radius_m = 0;    ///< rays that meet a facet nearer than this to an edge are left out
  double facet_bias_sd_m = 0;  ///< range bias: each facet in each scan lies off by its own offset
};

struct EfficiencyTrial {
  bool refused = false;
  double rotation_rad = 0;
  double translation_m = 0;  ///< displacement at the die's centre
  double nees = 0;           ///< error' covariance^-1 error, six degrees of freedom
  double misclosure_chi_square = 0;
  /// Lean of the fitted upper facet towards the scanner, less the true one: mean of both scans
  /// (rad).
  double top_tilt_rad = 0;
  /// Smallest variance factor of the six fits and the largest.
  double least_variance_factor = 0, largest_variance_factor = 0;
};

/// Both scans of a trial, observed, and the truth behind them.
struct ObservedPair {
  ObservedDie master, slave;
  DieShape shape;                                      ///< scene frame
  RigidTransform master_from_slave;                    ///< the truth
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of the die, master frame
  double shared_edge_m = 0;
  double top_tilt_rad = 0;  ///< see EfficiencyTrial
};

/// Simulates both scans of the die alone and fits its facets; the facets' points are sorted by
/// their rays, and rays nearer than two standard deviations of the pointing to a facet's border are
/// left out (alea/facet/pointing.hpp). The same seed and trial give the same bits.
ObservedPair observe_pair(const EfficiencyCase& setting, std::uint64_t seed, std::uint64_t trial);

/// Simulates both scans, sorts the points to facets by their reported rays (the facet that a ray
/// meets last is where it enters a convex body), fits and registers with the exact edge. The same
/// seed and trial give the same bits.
EfficiencyTrial run_efficiency_trial(const EfficiencyCase& setting, std::uint64_t seed,
                                     std::uint64_t trial);

std::vector<EfficiencyTrial> run_efficiency(const EfficiencyCase& setting, std::uint64_t seed,
                                            std::size_t trials);

}  // namespace alea::experiments::die
