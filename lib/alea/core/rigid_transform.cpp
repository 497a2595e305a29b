#include "alea/core/rigid_transform.hpp"

#include <algorithm>
#include <cmath>

namespace alea {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

namespace {

/// The left Jacobian of SO(3): exp([w, v]) has the translation part V(w) v.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d k = skew(w);
  if (angle < 1e-4) return Eigen::Matrix3d::Identity() + k / 2 + k * k / 6;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / a2 * k +
         (angle - std::sin(angle)) / (a2 * angle) * k * k;
}

}  // namespace

Eigen::Matrix4d RigidTransform::matrix() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation;
  m.topRightCorner<3, 1>() = translation;
  return m;
}

RigidTransform RigidTransform::from_matrix(const Eigen::Matrix4d& matrix) {
  return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const double sine = q.vec().norm();  // of half the angle
  if (sine == 0) return Eigen::Vector3d::Zero();
  const double half = std::atan2(sine, std::abs(q.w()));
  return q.vec() * ((q.w() < 0 ? -2 : 2) * half / sine);
}

double rotation_angle_rad(const Eigen::Matrix3d& rotation) {
  return rotation_log(rotation).norm();
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& axis_angle_rad) {
  const double angle = axis_angle_rad.norm();
  const Eigen::Matrix3d k = skew(axis_angle_rad);
  if (angle < 1e-8) return Eigen::Matrix3d::Identity() + k + k * k / 2;
  return Eigen::AngleAxisd(angle, axis_angle_rad / angle).toRotationMatrix();
}

Eigen::Vector3d omega_phi_kappa_rad(const Eigen::Matrix3d& r) {
  const double cos_phi = std::hypot(r(0, 0), r(1, 0));
  const double phi = std::atan2(-r(2, 0), cos_phi);
  if (cos_phi < 1e-12) return {std::atan2(-r(1, 2), r(1, 1)), phi, 0.0};
  return {std::atan2(r(2, 1), r(2, 2)), phi, std::atan2(r(1, 0), r(0, 0))};
}

Eigen::Matrix3d rotation_from_omega_phi_kappa(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

RigidTransform perturb_left(const RigidTransform& estimate, const Vector6d& delta,
                            const Eigen::Vector3d& about_m) {
  const Eigen::Vector3d w = delta.head<3>();
  const RigidTransform change{rotation_exp(w), left_jacobian(w) * delta.tail<3>()};
  const RigidTransform to_point{Eigen::Matrix3d::Identity(), about_m};
  return to_point * change * to_point.inverse() * estimate;
}

Vector6d left_difference(const RigidTransform& truth, const RigidTransform& estimate,
                         const Eigen::Vector3d& about_m) {
  const RigidTransform to_point{Eigen::Matrix3d::Identity(), about_m};
  // Composed about the point from the start, so that far origins cost no digits.
  const RigidTransform change =
      (to_point.inverse() * truth) * (to_point.inverse() * estimate).inverse();
  Vector6d delta;
  delta.head<3>() = rotation_log(change.rotation);
  delta.tail<3>() = left_jacobian(delta.head<3>()).inverse() * change.translation;
  return delta;
}

TransformCovariance moved_to(const TransformCovariance& covariance,
                             const Eigen::Vector3d& about_m) {
  // A rotation w about the old point is w about the new one and a translation w x (new - old).
  Matrix6d move = Matrix6d::Identity();
  move.bottomLeftCorner<3, 3>() = -skew(about_m - covariance.about_m);
  return {move * covariance.covariance * move.transpose(), about_m};
}

}  // namespace alea
