#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/plane/plane_detector.hpp"
#include "tests/support/named_scenes.hpp"

namespace alea {

static void PrintTo(PlaneDetector detector, std::ostream* out) {
  *out << to_string(detector);
}

namespace {

using testing::LabelledScan;

// A corner of a room with a box on the floor: six planes face the scanner.
LabelledScan corner_with_box(double step_rad = 0.018) {
  std::vector<testing::Rectangle> scene{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}},
                                        {{0, 0, 0}, {3, 0, 0}, {0, 0, 2}},
                                        {{0, 0, 0}, {0, 3, 0}, {0, 0, 2}}};
  const auto box = testing::box_sides({1.2, 1.4, 0}, {0.5, 0.5, 0.5}, 0.4);
  scene.insert(scene.end(), box.begin(), box.end());
  testing::ScanOptions options;
  options.scanner = {2.9, 2.8, 1.3};
  options.step_rad = step_rad;
  return testing::scan_rectangles(scene, options);
}

bool same_bits(const PlaneRegion& a, const PlaneRegion& b) {
  return a.plane.normal == b.plane.normal && a.plane.offset_m == b.plane.offset_m &&
         a.centroid_m == b.centroid_m && a.rmse_m == b.rmse_m;
}

class EveryDetector : public ::testing::TestWithParam<PlaneDetector> {
 protected:
  PlaneDetectionOptions options() const {
    PlaneDetectionOptions o;
    o.detector = GetParam();
    o.min_points = 60;
    return o;
  }
};

INSTANTIATE_TEST_SUITE_P(Planes, EveryDetector,
                         ::testing::Values(PlaneDetector::cells, PlaneDetector::efficient_ransac,
                                           PlaneDetector::region_growing,
                                           PlaneDetector::ndt_ransac),
                         [](const auto& each) { return std::string(to_string(each.param)); });

// Intersection over union of the best region for each rectangle with at least `least` points.
std::map<int, double> best_overlaps(const LabelledScan& scan,
                                    const std::vector<PlaneRegion>& regions, std::size_t least) {
  std::map<int, std::size_t> size;
  for (const int r : scan.rectangle) ++size[r];
  std::map<int, double> best;
  for (const auto& [r, n] : size)
    if (n >= least) best[r] = 0;
  for (const PlaneRegion& region : regions) {
    std::map<int, std::size_t> common;
    for (const std::uint32_t i : region.indices) ++common[scan.rectangle[i]];
    for (const auto& [r, n] : common)
      if (best.contains(r))
        best[r] = std::max(best[r], static_cast<double>(n) /
                                        static_cast<double>(size[r] + region.indices.size() - n));
  }
  return best;
}

TEST_P(EveryDetector, FindsEachPlaneOfACornerWithABoxOnce) {
  const LabelledScan scan = corner_with_box(0.012);
  PlaneDetectionOptions wanted = options();
  wanted.min_points = 100;
  const auto regions = detect_planes(scan.cloud, wanted);
  const auto overlaps = best_overlaps(scan, regions, 120);
  EXPECT_GE(overlaps.size(), 4u);
  for (const auto& [rectangle, overlap] : overlaps) EXPECT_GT(overlap, 0.75) << rectangle;
  EXPECT_GE(regions.size(), overlaps.size());
  EXPECT_LE(regions.size(), 6u);
}

TEST_P(EveryDetector, GivesAPointToOneRegionWithinTheToleranceAtMost) {
  const LabelledScan scan = corner_with_box();
  std::vector<int> uses(scan.cloud.size(), 0);
  for (const PlaneRegion& region : detect_planes(scan.cloud, options())) {
    EXPECT_TRUE(std::is_sorted(region.indices.begin(), region.indices.end()));
    EXPECT_GE(region.plane.signed_distance(*scan.cloud.scanner_position), 0);
    EXPECT_LT(region.rmse_m, 0.003);
    for (const std::uint32_t i : region.indices) {
      ++uses[i];
      // The members were chosen by the plane before the last fit.
      EXPECT_LT(std::abs(region.plane.signed_distance(scan.cloud.positions[i])), 0.0065);
    }
  }
  EXPECT_LE(*std::max_element(uses.begin(), uses.end()), 1);
}

// Whether a region has a member within 4 cm of a point.
bool reaches(const Cloud& cloud, const PlaneRegion& region, const Eigen::Vector3d& p) {
  return std::any_of(region.indices.begin(), region.indices.end(), [&](std::uint32_t i) {
    return (cloud.positions[i] - p).squaredNorm() < 0.04 * 0.04;
  });
}

TEST(Cells, GivePointsAtASharedBorderToTheNearestPlane) {
  const LabelledScan scan = corner_with_box(0.012);
  const auto regions = detect_planes(scan.cloud, {});
  std::size_t contested = 0, farther = 0;
  for (const PlaneRegion& region : regions)
    for (const std::uint32_t i : region.indices) {
      const Eigen::Vector3d& p = scan.cloud.positions[i];
      const double own = std::abs(region.plane.signed_distance(p));
      for (const PlaneRegion& other : regions) {
        const double distance = std::abs(other.plane.signed_distance(p));
        if (&other == &region || distance > 0.006 || !reaches(scan.cloud, other, p)) continue;
        ++contested;
        // The last fit moves the planes a little after the points were assigned.
        farther += own > distance + 5e-4;
      }
    }
  EXPECT_GT(contested, 20u);
  EXPECT_LE(20 * farther, contested);
}

TEST_P(EveryDetector, GivesTheSameBitsForAnyOrderOfThePoints) {
  const LabelledScan scan = corner_with_box();
  const auto regions = detect_planes(scan.cloud, options());
  const testing::Shuffled mixed = testing::shuffled(scan.cloud, 7);
  const auto again = detect_planes(mixed.cloud, options());
  ASSERT_EQ(again.size(), regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    EXPECT_TRUE(same_bits(regions[r], again[r])) << r;
    std::vector<std::uint32_t> back;
    for (const std::uint32_t i : again[r].indices) back.push_back(mixed.origin[i]);
    std::sort(back.begin(), back.end());
    EXPECT_EQ(back, regions[r].indices);
  }
}

TEST_P(EveryDetector, GivesTheSameBitsForOneThreadAndForTwo) {
  const LabelledScan scan = corner_with_box();
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return detect_planes(scan.cloud, options());
  };
  const auto one = run(1);
  const auto two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t r = 0; r < one.size(); ++r) {
    EXPECT_TRUE(same_bits(one[r], two[r]));
    EXPECT_EQ(one[r].indices, two[r].indices);
  }
}

TEST_P(EveryDetector, FollowsACloudThatIsMovedBy500Kilometres) {
  const LabelledScan scan = corner_with_box();
  const Eigen::Vector3d shift(5e5, -5e5, 5e5);
  Cloud far = scan.cloud;
  for (Eigen::Vector3d& p : far.positions) p += shift;
  *far.scanner_position += shift;
  const auto here = detect_planes(scan.cloud, options());
  const auto there = detect_planes(far, options());
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t r = 0; r < here.size(); ++r) {
    EXPECT_EQ(here[r].indices, there[r].indices);
    EXPECT_LT(here[r].plane.normal.cross(there[r].plane.normal).norm(), 1e-9);
    EXPECT_LT((here[r].centroid_m + shift - there[r].centroid_m).norm(), 1e-9);
    EXPECT_NEAR(there[r].plane.signed_distance(here[r].centroid_m + shift), 0, 1e-9);
  }
}

TEST_P(EveryDetector, GivesTheSameMembersInMillimetresAndFeet) {
  const LabelledScan scan = corner_with_box();
  const auto metres = detect_planes(scan.cloud, options());
  for (const double unit : {1000.0, 1 / 0.3048}) {
    Cloud scaled = scan.cloud;
    for (Eigen::Vector3d& p : scaled.positions) p *= unit;
    *scaled.scanner_position *= unit;
    PlaneDetectionOptions o = options();
    o.tolerance_m *= unit;
    const auto regions = detect_planes(scaled, o);
    ASSERT_EQ(regions.size(), metres.size()) << unit;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      EXPECT_EQ(regions[r].indices, metres[r].indices) << unit;
      EXPECT_NEAR(regions[r].rmse_m, metres[r].rmse_m * unit, 1e-9 * unit);
    }
  }
}

TEST_P(EveryDetector, LeavesOutPointsThatAreNotFinite) {
  const LabelledScan scan = corner_with_box();
  Cloud spoilt = scan.cloud;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  spoilt.positions.push_back({nan, 0, 0});
  spoilt.positions.push_back({0, std::numeric_limits<double>::infinity(), 0});
  const auto regions = detect_planes(spoilt, options());
  const auto clean = detect_planes(scan.cloud, options());
  ASSERT_EQ(regions.size(), clean.size());
  for (std::size_t r = 0; r < regions.size(); ++r) EXPECT_EQ(regions[r].indices, clean[r].indices);
}

TEST_P(EveryDetector, FindsNothingInNothing) {
  EXPECT_TRUE(detect_planes({}, options()).empty());
  Cloud same;
  same.positions.assign(500, Eigen::Vector3d(1, 2, 3));
  for (const PlaneRegion& region : detect_planes(same, options()))
    EXPECT_TRUE(region.plane.normal.allFinite());
  Cloud bad;
  bad.positions.assign(500, Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(detect_planes(bad, options()).empty());
}

TEST_P(EveryDetector, RefusesOptionsOutOfRange) {
  PlaneDetectionOptions o = options();
  o.tolerance_m = 0;
  EXPECT_THROW(detect_planes({}, o), Error);
  o = options();
  o.min_points = 2;
  EXPECT_THROW(detect_planes({}, o), Error);
  o = options();
  o.cell_m = -1;
  EXPECT_THROW(detect_planes({}, o), Error);
}

TEST(PlaneDetectorNames, ReadBack) {
  for (const auto d : {PlaneDetector::cells, PlaneDetector::efficient_ransac,
                       PlaneDetector::region_growing, PlaneDetector::ndt_ransac})
    EXPECT_EQ(plane_detector_from_name(to_string(d)), d);
  EXPECT_THROW(plane_detector_from_name("ransac"), Error);
}

}  // namespace
}  // namespace alea
