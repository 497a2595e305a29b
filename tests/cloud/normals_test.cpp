#include "alea/cloud/normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/shuffled_order.hpp"

namespace alea {
namespace {

// A noisy plane with a normal of its own and a sphere beside it.
Cloud plane_and_sphere(int n, const Eigen::Vector3d& offset) {
  RandomStream stream({3, 0, 0, 0, Purpose::test});
  Cloud cloud;
  for (int i = 0; i < n; ++i) {
    const double u = 4 * stream.uniform() - 2, v = 4 * stream.uniform() - 2;
    cloud.positions.push_back(offset + Eigen::Vector3d(5 + 0.25 * u, u, v));
  }
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d d(stream.normal(), stream.normal(), stream.normal());
    cloud.positions.push_back(offset + Eigen::Vector3d(-6, 0, 0) + 2 * d.normalized());
  }
  return cloud;
}

TEST(Normals, FollowPlaneAndSphereAndFaceTheScanner) {
  const int n = 4000;
  const Cloud cloud = plane_and_sphere(n, Eigen::Vector3d::Zero());
  const auto normals = estimate_normals(cloud, {});
  ASSERT_EQ(normals.size(), cloud.size());
  const Eigen::Vector3d of_plane = Eigen::Vector3d(-1, 0.25, 0).normalized();
  for (int i = 0; i < n; ++i) EXPECT_GT(normals[i].dot(of_plane), 1 - 1e-9);
  for (std::size_t i = n; i < cloud.size(); ++i) {
    const Eigen::Vector3d outward = (cloud.positions[i] - Eigen::Vector3d(-6, 0, 0)) / 2;
    EXPECT_GT(std::abs(normals[i].dot(outward)), 0.995);
    EXPECT_LE(normals[i].dot(cloud.positions[i]), 0);
  }
}

TEST(Normals, FaceThePlaceThatIsNamed) {
  const Cloud cloud = plane_and_sphere(500, Eigen::Vector3d::Zero());
  const auto normals = estimate_normals(cloud, {16, Eigen::Vector3d(10, 0, 0)});
  for (int i = 0; i < 500; ++i) EXPECT_GT(normals[i].x(), 0.9);
}

TEST(Normals, HoldFarFromTheOrigin) {
  const Eigen::Vector3d far(5e5, -5e5, 100);
  const auto near_origin = estimate_normals(plane_and_sphere(1000, {0, 0, 0}), {});
  const auto far_away = estimate_normals(plane_and_sphere(1000, far), {16, far});
  for (std::size_t i = 0; i < near_origin.size(); ++i)
    EXPECT_GT(near_origin[i].dot(far_away[i]), 1 - 1e-9) << i;
}

TEST(Normals, AreTheSameBitsForAnyOrderAndThreadCount) {
  const Cloud cloud = plane_and_sphere(3000, Eigen::Vector3d::Zero());
  const auto expected = estimate_normals(cloud, {});
  const auto order =
      experiments::shuffled_order(cloud.size(), RandomStream({4, 0, 0, 0, Purpose::test}));
  const ThreadLimit one(1);
  const auto shuffled = estimate_normals(subset(cloud, order), {});
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(shuffled[i], expected[order[i]]);
}

TEST(Normals, NeedThreeNeighbours) {
  EXPECT_THROW(estimate_normals({}, {2, {}}), Error);
  EXPECT_TRUE(estimate_normals({}, {}).empty());
  Cloud one;
  one.positions.emplace_back(1, 2, 3);
  EXPECT_NEAR(estimate_normals(one, {})[0].norm(), 1, 1e-12);
}

}  // namespace
}  // namespace alea
