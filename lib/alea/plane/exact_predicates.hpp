#pragma once

#include <Eigen/Core>

#include "alea/core/plane.hpp"

namespace alea {

/// The exact sign (-1, 0, +1) of det(a, b, c), the doubles taken as they are.
int exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether the planes' normals are exactly parallel or opposite, the doubles taken as they are.
bool exactly_parallel(const Plane& a, const Plane& b);

/// The exact sign (-1, 0, +1) of a . b.
int exact_sign_of_dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace alea
