#include "alea/markerless/range_image.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace alea {
namespace {

// A wall 5 m in front of a scanner at (1, 2, 3), 40 deg wide and high.
RangeImage wall() {
  Cloud cloud;
  for (int a = -80; a <= 80; ++a)
    for (int e = -80; e <= 80; ++e) {
      const double y = 5 * std::tan(a * 0.25 * 3.14159265 / 180);
      const double z = 5 * std::tan(e * 0.25 * 3.14159265 / 180);
      cloud.positions.emplace_back(6, 2 + y, 3 + z);
    }
  return {cloud, {1, 2, 3}, 3.14159265 / 180};
}

TEST(RangeImage, SpaceBeforeTheWallIsFreeBehindItNothingIsKnown) {
  const RangeImage image = wall();
  EXPECT_TRUE(image.is_in_free_space({4, 2, 3}, 0.3));
  EXPECT_FALSE(image.is_in_free_space({5.9, 2, 3}, 0.3));
  EXPECT_FALSE(image.is_in_free_space({8, 2, 3}, 0.3));
  ASSERT_TRUE(image.free_range_m({4, 2, 3}));
  EXPECT_NEAR(*image.free_range_m({4, 2, 3}), 5, 0.01);
}

TEST(RangeImage, WhereNothingWasMeasuredNothingIsContradicted) {
  const RangeImage image = wall();
  EXPECT_FALSE(image.free_range_m({-4, 2, 3}));
  EXPECT_FALSE(image.is_in_free_space({-4, 2, 3}, 0.3));
}

TEST(RangeImage, AThinPostStillStopsItsNeighbourhood) {
  Cloud cloud;
  for (int a = -40; a <= 40; ++a)
    for (int e = -40; e <= 40; ++e) {
      const double azimuth = a * 0.5 * 3.14159265 / 180, elevation = e * 0.5 * 3.14159265 / 180;
      const double range = a == 0 ? 2 : 10;  // a post one column wide
      cloud.positions.push_back(range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                        std::cos(elevation) * std::sin(azimuth),
                                                        std::sin(elevation)));
    }
  const RangeImage image(cloud, Eigen::Vector3d::Zero(), 3.14159265 / 180);
  EXPECT_FALSE(image.is_in_free_space({1.99, 0.03, 0}, 0.3));
  EXPECT_TRUE(image.is_in_free_space({1.7, 0.3, 0}, 0.3));
}

}  // namespace
}  // namespace alea
