#include "alea/core/rigid_transform.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

Eigen::Vector3d random_vector(RandomStream& stream) {
  return {stream.normal(), stream.normal(), stream.normal()};
}

TEST(RigidTransform, ComposesAndInverts) {
  RandomStream stream({1, 0, 0, 0, Purpose::test});
  const RigidTransform a_from_b{rotation_exp(random_vector(stream)), random_vector(stream)};
  const RigidTransform b_from_c{rotation_exp(random_vector(stream)), random_vector(stream)};
  const Eigen::Vector3d p_in_c = random_vector(stream);
  EXPECT_LT(((a_from_b * b_from_c) * p_in_c - a_from_b * (b_from_c * p_in_c)).norm(), 1e-14);
  EXPECT_LT((a_from_b.inverse() * (a_from_b * p_in_c) - p_in_c).norm(), 1e-14);
}

TEST(RotationLog, InvertsExpAlsoNearZeroAndNearPi) {
  RandomStream stream({2, 0, 0, 0, Purpose::test});
  for (const double angle :
       {0.0, 1e-14, 1e-9, 1e-5, 0.3, 2.0, std::numbers::pi - 1e-9, std::numbers::pi - 1e-4}) {
    const Eigen::Vector3d axis = random_vector(stream).normalized();
    const Eigen::Vector3d log = rotation_log(rotation_exp(axis * angle));
    EXPECT_LT((log - axis * angle).norm(), 1e-8 * std::max(angle, 1e-6)) << angle;
    EXPECT_NEAR(rotation_angle_rad(rotation_exp(axis * angle)), angle, 1e-9 * std::max(angle, 1e-5))
        << angle;
  }
}

TEST(OmegaPhiKappa, RoundTripsAndHandlesGimbalLock) {
  RandomStream stream({3, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d r = rotation_exp(2 * random_vector(stream));
    EXPECT_LT((rotation_from_omega_phi_kappa(omega_phi_kappa_rad(r)) - r).norm(), 1e-12);
  }
  const Eigen::Matrix3d lock = rotation_from_omega_phi_kappa({0.4, std::numbers::pi / 2, 0.9});
  EXPECT_LT((rotation_from_omega_phi_kappa(omega_phi_kappa_rad(lock)) - lock).norm(), 1e-12);
}

TEST(PerturbLeft, LeftDifferenceIsItsInverseAlsoFarFromTheOrigin) {
  RandomStream stream({4, 0, 0, 0, Purpose::test});
  const Eigen::Vector3d about(5e5, 4e6, 100);
  const RigidTransform estimate{rotation_exp(random_vector(stream)), about + random_vector(stream)};
  Vector6d delta;
  delta << 0.01, -0.02, 0.03, 0.1, -0.2, 0.3;
  const RigidTransform truth = perturb_left(estimate, delta, about);
  EXPECT_LT((left_difference(truth, estimate, about) - delta).norm(), 1e-8);
}

// A perturbation about one point, applied to that point, is the perturbation that moved_to predicts
// about another.
TEST(TransformCovariance, MovesWithItsPoint) {
  RandomStream stream({5, 0, 0, 0, Purpose::test});
  const Eigen::Vector3d from = random_vector(stream), to = random_vector(stream);
  Vector6d sd;
  sd << 1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6;
  TransformCovariance covariance{sd.cwiseAbs2().asDiagonal(), from};
  covariance.covariance(0, 4) = covariance.covariance(4, 0) = 3e-12;
  Matrix6d jacobian;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = 1e-6 * Vector6d::Unit(i);
    jacobian.col(i) = left_difference(perturb_left({}, step, from), {}, to) / 1e-6;
  }
  const Matrix6d expected = jacobian * covariance.covariance * jacobian.transpose();
  EXPECT_LT((moved_to(covariance, to).covariance - expected).norm(), 1e-5 * expected.norm());
}

}  // namespace
}  // namespace alea
