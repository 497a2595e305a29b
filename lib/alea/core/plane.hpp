#pragma once

#include <Eigen/Core>

namespace alea {

/// The points x with normal . x = offset_m. The normal has unit length.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset_m = 0;

  /// Positive on the side that the normal points to, metres.
  double signed_distance(const Eigen::Vector3d& p) const { return normal.dot(p) - offset_m; }
  Plane flipped() const { return {-normal, -offset_m}; }
};

/// The points point + t * direction. The direction has unit length.
struct Line {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// Two unit vectors e1, e2 (columns) with [e1 e2 normal] right-handed; the same for the same
/// normal.
Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& normal);

}  // namespace alea
