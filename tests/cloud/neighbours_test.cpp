#include "alea/cloud/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

std::vector<Eigen::Vector3d> random_points(int n) {
  RandomStream stream({2, 0, 0, 0, Purpose::test});
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < n; ++i)
    points.emplace_back(stream.normal(), stream.normal(), stream.normal());
  return points;
}

std::vector<Neighbour> brute_force(const std::vector<Eigen::Vector3d>& points,
                                   const Eigen::Vector3d& p) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    all.push_back({i, (points[i] - p).squaredNorm()});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.squared_distance_m2 < b.squared_distance_m2;
  });
  return all;
}

TEST(NeighbourIndex, AgreesWithBruteForce) {
  const auto points = random_points(500);
  const NeighbourIndex index(points);
  for (int q = 0; q < 50; ++q) {
    const Eigen::Vector3d p = 0.9 * points[q];
    const auto expected = brute_force(points, p);
    const auto nearest = index.nearest(p, 7);
    ASSERT_EQ(nearest.size(), 7u);
    for (int k = 0; k < 7; ++k) EXPECT_EQ(nearest[k].index, expected[k].index);
    const auto within = index.within(p, 0.5);
    const auto count = std::count_if(expected.begin(), expected.end(), [](const Neighbour& n) {
      return n.squared_distance_m2 < 0.25;
    });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(within.size()), count);
  }
}

TEST(NeighbourIndex, FindsTheNearestWithinADistance) {
  const auto points = random_points(2000);
  const NeighbourIndex index(points);
  for (const Eigen::Vector3d& q : random_points(100)) {
    const Eigen::Vector3d p = 1.1 * q;
    const Neighbour expected = brute_force(points, p).front();
    const auto found = index.nearest_one(p);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->index, expected.index);
    const double distance_m = std::sqrt(expected.squared_distance_m2);
    EXPECT_TRUE(index.nearest_one(p, distance_m * 1.001));
    EXPECT_FALSE(index.nearest_one(p, distance_m * 0.999));
  }
}

TEST(NeighbourIndex, OrdersEqualDistancesByPlaceInSpaceNotInTheCloud) {
  std::vector<Eigen::Vector3d> points;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) points.emplace_back(x, y, z);
  const std::vector<Eigen::Vector3d> backwards(points.rbegin(), points.rend());
  const NeighbourIndex index(points), other(backwards);
  for (const Eigen::Vector3d& p : points) {
    const auto a = index.nearest(p, 10), b = other.nearest(p, 10);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(points[a[i].index], backwards[b[i].index]);
  }
}

TEST(NeighbourIndex, ReturnsWhatThereIsWhereFewerThanKExist) {
  const auto points = random_points(3);
  EXPECT_EQ(NeighbourIndex(points).nearest(points[0], 7).size(), 3u);
}

}  // namespace
}  // namespace alea
