#include "alea/cloud/sampling.hpp"

#include <gtest/gtest.h>

#include <map>

#include "alea/cloud/canonical_order.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/shuffled_order.hpp"

namespace alea {
namespace {

Cloud random_cloud(int n) {
  RandomStream stream({5, 0, 0, 0, Purpose::test});
  Cloud cloud;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d p(3 * stream.normal(), stream.normal(), stream.uniform());
    cloud.positions.push_back(p);
    cloud.intensity.push_back(static_cast<float>(stream.uniform()));
    cloud.normals.push_back(p.normalized().cast<float>());
    cloud.colours.push_back({static_cast<std::uint16_t>(stream.below(65536)), 7, 65535});
  }
  cloud.scanner_position = Eigen::Vector3d(1, 2, 3);
  return cloud;
}

Cloud shuffled(const Cloud& cloud) {
  const RandomStream stream({6, 0, 0, 0, Purpose::test});
  return subset(cloud, experiments::shuffled_order(cloud.size(), stream));
}

void expect_same(const Cloud& a, const Cloud& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colours, b.colours);
}

struct Sum {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double intensity = 0;
  int count = 0;
};

TEST(GridAverage, IsTheMeanOfEachCell) {
  const Cloud cloud = random_cloud(20000);
  const double cell_m = 0.3;
  Eigen::Vector3d low = cloud.positions[0];
  for (const auto& p : cloud.positions) low = low.cwiseMin(p);
  std::map<std::array<int, 3>, Sum> cells;  // by z, y, x
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d steps = (cloud.positions[i] - low) / cell_m;
    Sum& sum = cells[{static_cast<int>(steps.z()), static_cast<int>(steps.y()),
                      static_cast<int>(steps.x())}];
    sum.position += cloud.positions[i];
    sum.intensity += cloud.intensity[i];
    ++sum.count;
  }
  const Cloud sampled = grid_average(cloud, cell_m);
  ASSERT_EQ(sampled.size(), cells.size());
  std::size_t i = 0;
  for (const auto& [key, sum] : cells) {
    EXPECT_LT((sampled.positions[i] - sum.position / sum.count).norm(), 1e-9);
    EXPECT_NEAR(sampled.intensity[i], sum.intensity / sum.count, 1e-6);
    EXPECT_NEAR(sampled.normals[i].norm(), 1, 1e-5);
    EXPECT_EQ(sampled.colours[i][1], 7);
    EXPECT_EQ(sampled.colours[i][2], 65535);
    ++i;
  }
  EXPECT_EQ(sampled.scanner_position, cloud.scanner_position);
}

TEST(Sampling, GivesTheSameBitsForAnyOrderAndThreadCount) {
  const Cloud cloud = random_cloud(300000);
  const Cloud other = shuffled(cloud);
  const Cloud grid = grid_average(cloud, 0.1), leaves = non_uniform_grid_sample(cloud, 8, 1);
  const Cloud chosen = canonical_order(random_sample(cloud, 1000, 1));
  const ThreadLimit one(1);
  expect_same(grid, grid_average(other, 0.1));
  expect_same(leaves, non_uniform_grid_sample(other, 8, 1));
  expect_same(chosen, canonical_order(random_sample(other, 1000, 1)));
}

TEST(RandomSample, KeepsExactlyTheCountAndDrawsEvenly) {
  const Cloud cloud = random_cloud(10000);
  EXPECT_EQ(random_sample(cloud, 20000, 1).size(), cloud.size());
  double share = 0;  // of points with x > 0: half of them, standard deviation 0.5 / sqrt(2000)
  const Cloud sampled = random_sample(cloud, 2000, 1);
  ASSERT_EQ(sampled.size(), 2000u);
  for (const auto& p : sampled.positions) share += p.x() > 0 ? 1.0 / 2000 : 0;
  EXPECT_NEAR(share, 0.5, 4 * 0.5 / std::sqrt(2000.0));
  EXPECT_NE(sampled.positions, random_sample(cloud, 2000, 2).positions);
}

TEST(NonUniformGrid, HalvesUntilALeafHoldsAtMostTheLimit) {
  const Cloud cloud = random_cloud(10446);
  // 2^11 leaves of 5.1 points; the published 1 044 604 points gave 2^17 leaves the same way.
  EXPECT_EQ(non_uniform_grid_sample(cloud, 8, 1).size(), 2048u);
  EXPECT_EQ(non_uniform_grid_sample(cloud, 1, 1).size(), cloud.size());
}

TEST(Sampling, SaysWhatIsWrong) {
  const Cloud cloud = random_cloud(10);
  EXPECT_THROW(grid_average(cloud, 0), Error);
  EXPECT_THROW(grid_average(cloud, 1e-9), Error);
  EXPECT_THROW(non_uniform_grid_sample(cloud, 0, 1), Error);
  EXPECT_TRUE(grid_average({}, 0.1).empty());
  EXPECT_TRUE(non_uniform_grid_sample({}, 8, 1).empty());
}

}  // namespace
}  // namespace alea
