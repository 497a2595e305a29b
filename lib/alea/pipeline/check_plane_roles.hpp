#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "alea/evaluate/check_planes.hpp"

namespace alea {

/// The planes nearest to the centroids given (master frame, m) check, the others calibrate. Throws
/// Error(input) for a centroid that no plane is near.
std::vector<CheckPlaneRole> named_check_planes(std::span<const CommonPlane> planes,
                                               std::span<const Eigen::Vector3d> centroids_m);

/// The planes that have a role, in their order.
std::vector<CommonPlane> planes_with_role(std::span<const CommonPlane> planes,
                                          std::span<const CheckPlaneRole> roles,
                                          CheckPlaneRole role);

}  // namespace alea
