#pragma once

#include <array>

#include "alea/core/rigid_transform.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/observed_die.hpp"

namespace alea {

/// A facet of a shape as a fit: the plane itself, centred at the point of it that is nearest to
/// `centre_m`, with this covariance (a, b, c as in PlaneFit).
PlaneFit exact_fit(const Plane& plane, const Eigen::Vector3d& centre_m,
                   const Eigen::Matrix3d& covariance = Eigen::Matrix3d::Zero());

/// What a scan without noise sees of a shape: the facets with these pips, in the scan's frame, each
/// centred near the die's origin, with one covariance for all (a, b in rad, c in m; may be zero).
/// Throws Error(usage) where the shape lacks a facet.
ObservedDie observe_exactly(const DieShape& shape, const std::array<int, 3>& pips,
                            const RigidTransform& scan_from_die,
                            const Eigen::Matrix3d& covariance = Eigen::Matrix3d::Zero());

/// The pips of the corner of a shape that a scanner at this point (die frame, m) sees: of each
/// axis the facet that faces it, ascending.
std::array<int, 3> facing_pips(const DieShape& shape, const Eigen::Vector3d& scanner_in_die_m);

}  // namespace alea
