#pragma once

#include <Eigen/Core>
#include <span>

#include "alea/core/rigid_transform.hpp"

namespace alea {

/// The rotation and translation that carry `from_points` onto `to_points` (metres, any two frames)
/// with the least weighted sum of squared distances; the scale is one. At least three points, not
/// on one line; no weights means equal weights. Throws Error(usage) for fewer points, unequal
/// counts or a weight that is not positive.
/// Horn 1987, Closed-form solution of absolute orientation using unit quaternions,
/// J. Opt. Soc. Am. A 4(4), 629-642.
RigidTransform horn(std::span<const Eigen::Vector3d> to_points,
                    std::span<const Eigen::Vector3d> from_points,
                    std::span<const double> weights = {});

}  // namespace alea
