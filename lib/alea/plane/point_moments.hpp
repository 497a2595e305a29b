#pragma once

#include <Eigen/Core>

namespace alea {

/// Count, mean and scatter (sum of squared deviations from the mean) of a set of points.
struct PointMoments {
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();

  /// Mean squared distance to the plane through `point` with the unit `normal`.
  double mean_square_distance(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) const {
    const double shift = normal.dot(mean - point);
    return normal.dot(scatter * normal) / count + shift * shift;
  }
};

/// Moments of the union (Chan, Golub, LeVeque 1983).
PointMoments merged(const PointMoments& a, const PointMoments& b);

/// The plane of moments: through the mean, normal to the direction of least scatter.
struct MomentPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double thickness = 0;  ///< standard deviation along the normal
  double breadth = 0;    ///< standard deviation along the shorter direction in the plane
};

/// Eigenvectors of the scatter in closed form (trigonometric solution of the cubic, cross product
/// of rows; Eberly 2014, A robust eigensolver for 3x3 symmetric matrices).
MomentPlane plane_of(const PointMoments& moments);

}  // namespace alea
