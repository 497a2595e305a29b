#include "alea/transform/horn.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"

namespace alea {
namespace {

Eigen::Vector3d normal_vector(RandomStream& stream) {
  return {stream.normal(), stream.normal(), stream.normal()};
}

std::vector<Eigen::Vector3d> random_points(RandomStream& stream, int count) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(5 * normal_vector(stream));
  return points;
}

std::vector<Eigen::Vector3d> moved(const RigidTransform& to_from_from,
                                   const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector3d& p : points) out.push_back(to_from_from * p);
  return out;
}

TEST(Horn, RecoversATransformFromThreeExactPointsAtAnyAngle) {
  RandomStream stream({21, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 500; ++i) {
    // Every tenth rotation is a half turn, where a quaternion's scalar part vanishes.
    const double angle = i % 10 == 0 ? std::numbers::pi : std::numbers::pi * stream.uniform();
    const RigidTransform truth{rotation_exp(angle * normal_vector(stream).normalized()),
                               100 * normal_vector(stream)};
    const auto from = random_points(stream, 3);
    const RigidTransform found = horn(moved(truth, from), from);
    EXPECT_LT(rotation_angle_rad(found.rotation * truth.rotation.transpose()), 1e-12);
    EXPECT_LT((found.translation - truth.translation).norm(), 1e-11);
  }
}

TEST(Horn, NeverReturnsAReflection) {
  const std::vector<Eigen::Vector3d> from{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const std::vector<Eigen::Vector3d> mirrored{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, 0}};
  const Eigen::Matrix3d rotation = horn(mirrored, from).rotation;
  EXPECT_NEAR((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-14);
  EXPECT_NEAR(rotation.determinant(), 1, 1e-14);
}

// No small change of the six parameters makes the weighted sum of squares smaller.
TEST(Horn, MinimisesTheWeightedSumOfSquares) {
  RandomStream stream({22, 0, 0, 0, Purpose::test});
  const auto from = random_points(stream, 8);
  auto to = moved({rotation_exp({0.3, -1, 2}), {1, 2, 3}}, from);
  for (Eigen::Vector3d& p : to) p += 0.1 * normal_vector(stream);
  const std::vector<double> weights{1, 2, 3, 4, 5, 6, 7, 8};
  const RigidTransform found = horn(to, from, weights);
  const auto cost = [&](const RigidTransform& t) {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      sum += weights[i] * (to[i] - t * from[i]).squaredNorm();
    return sum;
  };
  for (int k = 0; k < 6; ++k)
    for (const double step : {-1e-4, 1e-4})
      EXPECT_GT(cost(perturb_left(found, step * Vector6d::Unit(k), to[0])), cost(found));
}

TEST(Horn, RejectsTooFewPointsUnequalCountsAndBadWeights) {
  const std::vector<Eigen::Vector3d> two(2, Eigen::Vector3d::Zero()),
      three{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_THROW(horn(two, two), Error);
  EXPECT_THROW(horn(three, two), Error);
  EXPECT_THROW(horn(three, three, std::vector<double>{1, 1}), Error);
  EXPECT_THROW(horn(three, three, std::vector<double>{1, 1, 0}), Error);
}

}  // namespace
}  // namespace alea
