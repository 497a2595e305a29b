#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/plane/plane_detector.hpp"
#include "tests/support/named_scenes.hpp"

namespace alea {
namespace {

using testing::cube_scan;
using testing::LabelledScan;
using testing::Rectangle;

double angle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::asin(std::min(1.0, a.cross(b).norm()));
}

TEST(Cells, FindTheThreeFacetsOfALoneCube) {
  for (const double edge : {0.1, 0.3, 0.5}) {
    const LabelledScan scan = cube_scan(edge, 6, 0.8, 0.0005);
    const auto regions = detect_planes(scan.cloud);
    ASSERT_EQ(regions.size(), 3u) << edge;
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d normal = regions[a].plane.normal;
      EXPECT_LT(std::abs(normal.dot(regions[(a + 1) % 3].plane.normal)), 0.02) << edge;
    }
  }
}

TEST(Cells, FindATopFacetSeenAt4Degrees) {
  // Rows on the top facet are 14 times as far apart as points in a row.
  const LabelledScan scan = cube_scan(0.5, 6, 0.4, 0.0005);
  const auto regions = detect_planes(scan.cloud);
  const auto top = std::find_if(regions.begin(), regions.end(), [](const PlaneRegion& r) {
    return angle_rad(r.plane.normal, Eigen::Vector3d::UnitZ()) < 0.01;
  });
  ASSERT_NE(top, regions.end());
  const auto members = std::count_if(top->indices.begin(), top->indices.end(),
                                     [&](std::uint32_t i) { return scan.rectangle[i] == 4; });
  const auto truth = std::count(scan.rectangle.begin(), scan.rectangle.end(), 4);
  EXPECT_GT(members, 0.85 * static_cast<double>(truth));
}

TEST(Cells, KeepParallelPlanesTwoCentimetresApartAsunder) {
  const std::vector<Rectangle> scene{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                     {{0.3, 0.3, 0.02}, {0.4, 0, 0}, {0, 0.4, 0}}};
  testing::ScanOptions options;
  options.scanner = {0.5, 0.4, 2};
  options.step_rad = 0.003;
  const LabelledScan scan = testing::scan_rectangles(scene, options);
  const auto regions = detect_planes(scan.cloud);
  ASSERT_EQ(regions.size(), 2u);
  for (const std::uint32_t i : regions[1].indices) EXPECT_EQ(scan.rectangle[i], 1);
}

TEST(Cells, KeepTwoCoplanarFacetsOfTwoCubesAsunder) {
  std::vector<Rectangle> scene = testing::box_sides({3, 0, 0}, {0.3, 0.3, 0.3}, 0);
  const auto second = testing::box_sides({3, 1.2, 0}, {0.3, 0.3, 0.3}, 0);
  scene.insert(scene.end(), second.begin(), second.end());
  testing::ScanOptions options;
  options.scanner = {0, 0.6, 1.5};
  options.window = {3, 0.6, 0.15};
  options.window_radius_m = 1.2;
  options.step_rad = 0.0015;
  const auto regions = detect_planes(testing::scan_rectangles(scene, options).cloud);
  EXPECT_EQ(regions.size(), 6u);
}

TEST(Cells, DoNotJoinFacetsOverARoundedEdge) {
  // Two facets of 0.4 m and the quarter cylinder of 3 cm radius between them.
  const double radius = 0.03;
  std::vector<Rectangle> scene{{{0, 0, 0}, {-0.4, 0, 0}, {0, 0.4, 0}},
                               {{radius, 0, -radius}, {0, 0.4, 0}, {0, 0, -0.4}}};
  constexpr int strips = 48;
  for (int k = 0; k < strips; ++k) {
    const auto at = [&](int j) {
      const double angle = j * std::numbers::pi / 2 / strips;
      return Eigen::Vector3d(radius * std::sin(angle), 0, radius * (std::cos(angle) - 1));
    };
    scene.push_back({at(k), at(k + 1) - at(k), {0, 0.4, 0}});
  }
  testing::ScanOptions options;
  options.scanner = {2, 0.3, 2};
  options.window = {0, 0.2, 0};
  options.window_radius_m = 0.5;
  options.step_rad = 0.0015;
  const LabelledScan scan = testing::scan_rectangles(scene, options);
  const auto regions = detect_planes(scan.cloud);
  ASSERT_GE(regions.size(), 2u);
  for (int r = 0; r < 2; ++r) {
    const bool is_first = std::abs(regions[r].plane.normal.z()) > 0.7;
    const Eigen::Vector3d truth = is_first ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    EXPECT_LT(angle_rad(regions[r].plane.normal, truth), 0.003);
  }
  EXPECT_LT(std::abs(regions[0].plane.normal.dot(regions[1].plane.normal)), 0.005);
}

TEST(Cells, MakeNoBevelOfASharpEdgeForAnyPhaseOfTheGrid) {
  const LabelledScan scan = cube_scan(0.5, 6, 0.8, 0.001);
  for (int phase = 0; phase < 12; ++phase) {
    Cloud cloud = scan.cloud;
    cloud.positions.push_back({-0.03 * phase, -1 - 0.05 * phase, -0.02 * phase});
    EXPECT_EQ(detect_planes(cloud).size(), 3u) << phase;
  }
}

TEST(Cells, DuplicatedPointsChangeNoPlane) {
  const LabelledScan scan = cube_scan(0.5, 6, 0.8, 0.001);
  Cloud twice = scan.cloud;
  twice.positions.insert(twice.positions.end(), scan.cloud.positions.begin(),
                         scan.cloud.positions.end());
  PlaneDetectionOptions options;
  const auto once = detect_planes(scan.cloud, options);
  options.min_points *= 2;
  const auto regions = detect_planes(twice, options);
  ASSERT_EQ(regions.size(), once.size());
  for (std::size_t r = 0; r < once.size(); ++r) {
    EXPECT_LT(angle_rad(regions[r].plane.normal, once[r].plane.normal), 2e-4);
    EXPECT_NEAR(static_cast<double>(regions[r].indices.size()),
                2 * static_cast<double>(once[r].indices.size()),
                0.1 * static_cast<double>(once[r].indices.size()));
  }
}

TEST(Cells, AStrayPointAThousandKilometresOffDoesNotDisturb) {
  const LabelledScan scan = cube_scan(0.5, 6, 0.8, 0.001);
  Cloud stray = scan.cloud;
  stray.positions.push_back({-1e6, 3e5, 0});
  stray.positions.push_back({1e300, -1e300, 1e300});
  const auto regions = detect_planes(stray);
  const auto clean = detect_planes(scan.cloud);
  ASSERT_EQ(regions.size(), clean.size());
  for (std::size_t r = 0; r < clean.size(); ++r)
    EXPECT_LT(angle_rad(regions[r].plane.normal, clean[r].plane.normal), 1e-3);
}

TEST(Cells, FitNoiseFreeFacetsToRounding) {
  std::vector<Rectangle> scene{{{0, 0, 0}, {1, 0.2, 0}, {-0.2, 1, 0}}};
  testing::ScanOptions options;
  options.scanner = {0.4, 0.5, 1.7};
  options.step_rad = 0.01;
  options.range_noise_m = 0;
  const auto regions = detect_planes(testing::scan_rectangles(scene, options).cloud);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_LT(angle_rad(regions[0].plane.normal, Eigen::Vector3d::UnitZ()), 1e-12);
  EXPECT_LT(std::abs(regions[0].plane.offset_m), 1e-12);
  EXPECT_LT(regions[0].rmse_m, 1e-12);
}

TEST(Cells, FindEachPlaneOfAFurnishedRoom) {
  testing::ScanOptions options;
  options.scanner = {3.5, 2.5, 1.5};
  options.step_rad = 0.009;
  LabelledScan scan = testing::scan_rectangles(testing::furnished_room(), options);
  PlaneDetectionOptions detection;
  detection.min_points = 200;
  const auto regions = detect_planes(scan.cloud, detection);
  EXPECT_GE(regions.size(), 12u);
  EXPECT_LE(regions.size(), 14u);
  for (const PlaneRegion& region : regions) EXPECT_LT(region.rmse_m, 0.002);
}

}  // namespace
}  // namespace alea
