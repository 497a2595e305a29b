#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace alea {

/// Angle between two directions; accurate where they are nearly parallel.
inline double angle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace alea
