#pragma once

#include <array>
#include <optional>

#include "alea/core/rigid_transform.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/observed_die.hpp"

namespace alea {

/// A transform between two scans with the covariance of its left perturbation about the origin of
/// the master's coordinates, which should be near the die.
struct FacetAdjustment {
  RigidTransform master_from_slave;
  Matrix6d covariance = Matrix6d::Zero();
  Eigen::Vector3d translation_by_edge = Eigen::Vector3d::Zero();  ///< m/m, master frame
  double chi_square = 0;
  int freedom = 0;
};

/// Length of the edge between two shared facets (m).
struct EdgeLength {
  double length_m = 0;
  double sd_m = 0;  ///< zero: exact
};

/// Generalised least squares on the facets that both scans see: three, or two and the length of
/// their edge between the two corners. Starts at the frames of the edge and both normals, which is
/// exact without noise.
FacetAdjustment adjust_shared_facets(const ObservedDie& master, const ObservedDie& slave,
                                     const std::optional<EdgeLength>& edge);

/// A shape with the standard deviations of its facets, independent of each other; both zero (an
/// exact shape) or both positive.
struct UncertainShape {
  DieShape shape;
  double tilt_sd_rad = 0;  ///< of each facet about two directions, at its centre
  double offset_sd_m = 0;
};

/// Generalised least squares on all six observed facets against a shape, by way of the die's frame.
/// All facets of the two corners must be known.
FacetAdjustment adjust_to_shape(const ObservedDie& master, const ObservedDie& slave,
                                const UncertainShape& shape);

/// scan_from_die of a shape's planes ([pips - 1], die frame) by the normals and the corner of the
/// three facets that a scan sees; exact where shape and scan are.
RigidTransform place_shape(const ObservedDie& die, const std::array<Plane, 6>& shape);

/// The middle of the die (m, scan frame), from the facets' centroids: near enough to choose an
/// origin.
Eigen::Vector3d approximate_centre(const ObservedDie& die);

/// The same observation in a frame whose origin is `origin_m`.
ObservedDie recentred(const ObservedDie& die, const Eigen::Vector3d& origin_m);

}  // namespace alea
