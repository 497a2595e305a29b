#pragma once

#include <Eigen/Core>

namespace alea {

/// The point that a transform's covariance refers to: the origin of the frame where it lies within
/// 1 km of the target, else the target's centre (m).
inline Eigen::Vector3d reference_point(const Eigen::Vector3d& target_m) {
  return target_m.norm() <= 1000 ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : target_m;
}

}  // namespace alea
