#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "alea/core/rigid_transform.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/observed_die.hpp"

namespace alea::experiments::die {

/// A die that is not quite a cube and two levelled stations that see it without noise.
struct SkewedDie {
  DieShape shape;                    ///< 1 looks up, in the frame of alea::cube
  RigidTransform master_from_slave;  ///< the truth
  ObservedDie master;
  ObservedDie slave;
  Eigen::Vector3d centre_in_master_m = Eigen::Vector3d::Zero();
  /// Corner to corner along the edge of the two shared facets; empty unless two are shared.
  std::optional<double> shared_edge_m;
};

struct SkewedDieOptions {
  double edge_m = 0.5;
  double tilt_sd_rad = 0;                      ///< each facet, two directions
  double size_sd_share = 0;                    ///< each of the three sizes
  double separation_rad = 1.5707963267948966;  ///< between the stations, as seen from the die
  std::array<double, 2> distance_m{6, 6};      ///< horizontal, from the die's centre
  double height_m = 1.35;                      ///< of the scanners above the die's centre
  Chirality chirality = Chirality::clockwise;
};

/// The first station looks 45 deg off the facets 2 and 3. The same seed and trial give the same
/// die, whatever the stations.
SkewedDie draw_skewed_die(const SkewedDieOptions& options, std::uint64_t seed, std::uint64_t trial);

/// Error of an estimate: the angle, and the displacement at the die's centre and RMS on a
/// horizontal ring of 5 m about it.
struct PoseError {
  double rotation_rad = 0;
  double at_die_m = 0;
  double ring5_m = 0;
};

PoseError pose_error(const RigidTransform& estimate, const SkewedDie& die);

}  // namespace alea::experiments::die
