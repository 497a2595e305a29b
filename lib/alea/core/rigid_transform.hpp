#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace alea {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// p_to = rotation * p_from + translation (metres). Name a variable `to_from_from`, e.g.
/// `master_from_slave`.
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return rotation * p + translation; }
  RigidTransform operator*(const RigidTransform& b) const {
    return {rotation * b.rotation, rotation * b.translation + translation};
  }
  RigidTransform inverse() const {
    return {rotation.transpose(), -(rotation.transpose() * translation)};
  }
  /// 4x4, for column vectors.
  Eigen::Matrix4d matrix() const;
  static RigidTransform from_matrix(const Eigen::Matrix4d& matrix);
};

/// The matrix with skew(v) * w = v x w.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Angle of a rotation matrix, in [0, pi] rad; accurate near 0 and near pi.
double rotation_angle_rad(const Eigen::Matrix3d& rotation);

/// Axis times angle (rad) of a rotation matrix, and back (Rodrigues).
Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);
Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& axis_angle_rad);

/// omega, phi, kappa (rad) with R = Rz(kappa) Ry(phi) Rx(omega). At phi = +-90 deg, where only a
/// combination is determined, kappa is set to zero.
Eigen::Vector3d omega_phi_kappa_rad(const Eigen::Matrix3d& rotation);
Eigen::Matrix3d rotation_from_omega_phi_kappa(const Eigen::Vector3d& omega_phi_kappa_rad);

/// T = Trans(about) exp(delta) Trans(-about) estimate, with delta = rotation x, y, z (rad),
/// translation x, y, z (m): the left perturbation in the frame that the transform maps to.
RigidTransform perturb_left(const RigidTransform& estimate, const Vector6d& delta,
                            const Eigen::Vector3d& about_m);

/// The delta for which `perturb_left(estimate, delta, about_m)` is `truth`.
Vector6d left_difference(const RigidTransform& truth, const RigidTransform& estimate,
                         const Eigen::Vector3d& about_m);

/// A transform with the covariance of its left perturbation about a stated point.
struct TransformCovariance {
  Matrix6d covariance =
      Matrix6d::Zero();  ///< order: rotation x, y, z (rad), translation x, y, z (m)
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();  ///< in the frame that the transform maps to
};

/// The same covariance expressed about another point.
TransformCovariance moved_to(const TransformCovariance& covariance, const Eigen::Vector3d& about_m);

}  // namespace alea
