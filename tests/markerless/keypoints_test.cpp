#include "alea/markerless/keypoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "alea/cloud/normals.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/shuffled_order.hpp"

namespace alea {
namespace {

/// The three faces of a unit cube that meet at the origin, seen from (2, 2, 2), a little noise.
Cloud corner() {
  RandomStream stream({31, 0, 0, 0, Purpose::test});
  Cloud cloud;
  cloud.scanner_position = Eigen::Vector3d(2, 2, 2);
  for (int face = 0; face < 3; ++face)
    for (int i = 0; i < 1600; ++i) {
      Eigen::Vector3d p(stream.uniform(), stream.uniform(), stream.uniform());
      p[face] = 0.0005 * stream.normal();
      cloud.positions.push_back(p);
    }
  for (const Eigen::Vector3d& n : estimate_normals(cloud, {}))
    cloud.normals.push_back(n.cast<float>());
  return cloud;
}

TEST(Harris, FindsTheCornerFirst) {
  const Cloud cloud = corner();
  for (const HarrisResponse response : {HarrisResponse::determinant, HarrisResponse::least}) {
    const auto found = harris_keypoints(cloud, {0.2, response, 1e-4});
    ASSERT_FALSE(found.empty());
    EXPECT_LT(found[0].position_m.norm(), 0.12);
    for (std::size_t i = 1; i < found.size(); ++i)
      EXPECT_GE(found[i - 1].response, found[i].response);
  }
}

TEST(Harris, VariantsThatCountEdgesDiffer) {
  const Cloud cloud = corner();
  const auto on_an_edge = [](const Keypoint& k) {
    const Eigen::Array3d p = k.position_m.array().abs();
    return (p < 0.1).count() == 2;
  };
  const auto corners = harris_keypoints(cloud, {0.2, HarrisResponse::determinant, 0.01});
  const auto edges = harris_keypoints(cloud, {0.2, HarrisResponse::middle, 0.1});
  EXPECT_GT(std::count_if(edges.begin(), edges.end(), on_an_edge),
            std::count_if(corners.begin(), corners.end(), on_an_edge));
}

TEST(Iss, FindsTheCornerAndNothingInTheMiddleOfAFace) {
  const auto found = iss_keypoints(corner(), {0.25, 0.2, 0.975, 0.975, 5});
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found[0].position_m.norm(), 0.2);
}

TEST(Keypoints, AreTheSameForAnyOrderAndThreadCount) {
  const Cloud cloud = corner();
  const RandomStream stream({32, 0, 0, 0, Purpose::test});
  const Cloud shuffled = subset(cloud, experiments::shuffled_order(cloud.size(), stream));
  const auto harris = harris_keypoints(cloud, {}), iss = iss_keypoints(cloud, {});
  const ThreadLimit one(1);
  const auto same = [](const std::vector<Keypoint>& a, const std::vector<Keypoint>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].position_m, b[i].position_m);
      EXPECT_EQ(a[i].response, b[i].response);
    }
  };
  same(harris, harris_keypoints(shuffled, {}));
  same(iss, iss_keypoints(shuffled, {}));
}

TEST(Keypoints, HarrisNeedsNormals) {
  Cloud cloud = corner();
  cloud.normals.clear();
  EXPECT_THROW(harris_keypoints(cloud, {}), Error);
}

}  // namespace
}  // namespace alea
