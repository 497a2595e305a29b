#include "alea/cloud/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

TEST(Spacing, OfAGridIsItsStepForAnyOrder) {
  Cloud cloud;
  for (int i = 0; i < 120; ++i)
    for (int j = 0; j < 90; ++j) cloud.positions.emplace_back(0.25 * i, 0.25 * j, 3);
  EXPECT_EQ(median_spacing_m(cloud), 0.25);
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  EXPECT_EQ(median_spacing_m(cloud), 0.25);
}

TEST(Spacing, IsTheMedianOfNearestNeighboursOfRandomPoints) {
  RandomStream random({9, 0, 0, 0, Purpose::test});
  Cloud cloud;
  for (int i = 0; i < 800; ++i)
    cloud.positions.emplace_back(random.normal(), random.normal(), 100 * random.normal());
  std::vector<double> nearest;
  for (const Eigen::Vector3d& p : cloud.positions) {
    double best = 1e9;
    for (const Eigen::Vector3d& q : cloud.positions)
      if (q != p) best = std::min(best, (p - q).squaredNorm());
    nearest.push_back(std::sqrt(best));
  }
  std::sort(nearest.begin(), nearest.end());
  EXPECT_DOUBLE_EQ(*median_spacing_m(cloud), nearest[399]);
}

TEST(Spacing, NeedsTwoDifferentPoints) {
  Cloud cloud;
  EXPECT_FALSE(median_spacing_m(cloud));
  cloud.positions.assign(5, {1, 2, 3});
  EXPECT_FALSE(median_spacing_m(cloud));
}

}  // namespace
}  // namespace alea
