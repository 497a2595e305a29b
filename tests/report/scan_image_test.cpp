#include "alea/report/scan_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/named_scenes.hpp"

namespace alea {
namespace {

TEST(ScanImage, ShowsAWallAsItIsSeenFromTheScanner) {
  // A wall in +x: its +y side is on the scanner's left.
  Cloud cloud;
  cloud.scanner_position = Eigen::Vector3d(1, 0, 0.5);
  for (int i = -50; i <= 50; ++i)
    for (int k = -30; k <= 30; ++k) cloud.positions.emplace_back(5, 0.03 * i, 0.5 + 0.03 * k);
  const ScanImage image = scan_image(cloud);
  const Eigen::Vector3d left = image.place({5, 1, 0.5}), right = image.place({5, -1, 0.5}),
                        high = image.place({5, 0, 1.5});
  EXPECT_LT(left.x(), right.x());
  EXPECT_NEAR(high.y(), std::atan2(1, 4) * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(left.z(), std::sqrt(17), 1e-12);
  const auto empty = std::count(image.nearest.begin(), image.nearest.end(), -1);
  EXPECT_LT(static_cast<double>(empty), 0.15 * static_cast<double>(image.nearest.size()));
}

TEST(ScanImage, TheNearestPointWins) {
  Cloud cloud;
  cloud.scanner_position = Eigen::Vector3d::Zero();
  for (const double range : {4.0, 2.0, 3.0})
    for (int i = -20; i <= 20; ++i)
      for (int k = -20; k <= 20; ++k)
        cloud.positions.emplace_back(range * Eigen::Vector3d(1, 0.01 * i, 0.01 * k));
  const ScanImage image = scan_image(cloud);
  for (const std::int64_t i : image.nearest) {
    if (i >= 0) {
      EXPECT_NEAR(cloud.positions[i].x(), 2, 1e-12);
    }
  }
}

TEST(ScanImage, AWindowThatStraddlesTheBackIsInOnePiece) {
  Cloud cloud;
  cloud.scanner_position = Eigen::Vector3d::Zero();
  for (int i = -40; i <= 40; ++i)
    for (int k = -10; k <= 10; ++k) cloud.positions.emplace_back(-4, 0.02 * i, 0.02 * k);
  const ScanImage image = scan_image(cloud);
  EXPECT_LT(image.width * image.step, 30);
}

TEST(ScanImage, AScanWithoutScannerIsSeenFromAbove) {
  testing::LabelledScan scan = testing::cube_scan(0.5, 4, 1.4, 0.005);
  scan.cloud.scanner_position.reset();
  const ScanImage image = scan_image(scan.cloud);
  EXPECT_EQ(image.x_name, "right (m)");
  EXPECT_GT(image.width, 20);
}

TEST(ScanImage, OnlyTheSurroundingsThatWereAskedFor) {
  const testing::LabelledScan room = testing::scan_rectangles(testing::furnished_room(), {});
  const Eigen::Vector3d about = room.cloud.positions[room.cloud.size() / 2];
  const ScanImage image = scan_image(room.cloud, {.about_m = about, .radius_m = 0.8});
  for (const std::int64_t i : image.nearest) {
    if (i >= 0) {
      EXPECT_LE((room.cloud.positions[i] - about).norm(), 0.8);
    }
  }
  EXPECT_EQ(scan_image(Cloud{}).width, 0);
}

}  // namespace
}  // namespace alea
