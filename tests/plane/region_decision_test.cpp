#include "alea/plane/region_decision.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/named_scenes.hpp"

namespace alea {
namespace {

using testing::LabelledScan;

TEST(ExactlyWithin, DecidesOnTheLastBit) {
  const Plane plane{Eigen::Vector3d(0, 0, 1), 0.25};
  const double above = 0.25 + 0.0078125;
  EXPECT_TRUE(exactly_within({{1e6, -1e6, above}}, plane, 0.0078125));
  EXPECT_FALSE(exactly_within({{1e6, -1e6, std::nextafter(above, 1)}}, plane, 0.0078125));
}

TEST(ExactlyWithin, MeasuresAlongTheNormalWhateverItsLength) {
  // The distance is 5 / |(3, 4, 0)| = 1 for x = 5/3.
  const Plane stretched{Eigen::Vector3d(3, 4, 0), 0};
  EXPECT_TRUE(exactly_within({{1.25, 0.3125, 7}}, stretched, 1));
  EXPECT_FALSE(exactly_within({{1.25, std::nextafter(0.3125, 1), 7}}, stretched, 1));
}

std::size_t from_rectangle(const LabelledScan& scan, const PlaneRegion& region, int rectangle) {
  return static_cast<std::size_t>(
      std::count_if(region.indices.begin(), region.indices.end(),
                    [&](std::uint32_t i) { return scan.rectangle[i] == rectangle; }));
}

/// The region that holds most points of a rectangle, or null where none holds half of them.
const PlaneRegion* region_of(const LabelledScan& scan, const std::vector<PlaneRegion>& regions,
                             int rectangle) {
  const auto all = std::count(scan.rectangle.begin(), scan.rectangle.end(), rectangle);
  for (const PlaneRegion& region : regions)
    if (2 * from_rectangle(scan, region, rectangle) > static_cast<std::size_t>(all) &&
        2 * from_rectangle(scan, region, rectangle) > region.indices.size())
      return &region;
  return nullptr;
}

// A cube so far away that the scanner draws a few rows on its top, wider apart than the cells are:
// each cell holds a line, and a line has no plane.
struct FewRows {
  LabelledScan scan = testing::cube_scan(0.5, 12, 0.6, 0.001);
  int top = *std::max_element(scan.rectangle.begin(), scan.rectangle.end());
  RegionBall ball{{0, 0, 0}, 1};
  FewRows() {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : scan.cloud.positions) sum += p;
    ball.centre_m = sum / static_cast<double>(scan.cloud.size());
  }
};

TEST(RegionDecision, FindsAFacetOfFewRowsThatTheCellsMiss) {
  const FewRows rows;
  const auto cells = detect_planes(rows.scan.cloud);
  ASSERT_EQ(region_of(rows.scan, cells, rows.top), nullptr)
      << "the cells find it: a harder case is needed";
  const auto decided = decide_regions(rows.scan.cloud, cells, rows.ball, {});
  const PlaneRegion* top = region_of(rows.scan, decided, rows.top);
  ASSERT_NE(top, nullptr);
  EXPECT_LT(top->plane.normal.cross(Eigen::Vector3d::UnitZ()).norm(), 0.03);
  // The facets that the cells found stay.
  for (const PlaneRegion& region : cells)
    EXPECT_TRUE(std::any_of(decided.begin(), decided.end(), [&](const PlaneRegion& other) {
      return std::includes(other.indices.begin(), other.indices.end(), region.indices.begin(),
                           region.indices.end());
    }));
}

TEST(RegionDecision, GivesTheSameBitsForAnyOrderOfThePoints) {
  const FewRows rows;
  const auto first = decide_regions(rows.scan.cloud, detect_planes(rows.scan.cloud), rows.ball, {});
  const testing::Shuffled mixed = testing::shuffled(rows.scan.cloud, 3);
  const auto again = decide_regions(mixed.cloud, detect_planes(mixed.cloud), rows.ball, {});
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].plane.normal, again[k].plane.normal);
    EXPECT_EQ(first[k].plane.offset_m, again[k].plane.offset_m);
  }
}

TEST(RegionDecision, JoinsPiecesOfOnePlaneAndDropsWhatNoPlaneConfirms) {
  const LabelledScan scan = testing::cube_scan(0.5, 4, 0.8, 0.004);
  auto candidates = detect_planes(scan.cloud);
  ASSERT_EQ(candidates.size(), 3u);
  // One facet in two halves, and a region across two facets.
  PlaneRegion low = candidates[0], high = candidates[0], across = candidates[1];
  low.indices.resize(low.indices.size() / 2);
  high.indices.erase(high.indices.begin(),
                     high.indices.begin() + static_cast<std::ptrdiff_t>(low.indices.size()));
  across.plane.normal = (candidates[1].plane.normal + candidates[2].plane.normal).normalized();
  across.plane.offset_m = across.plane.normal.dot(across.centroid_m);
  const std::size_t whole = candidates[0].indices.size();
  const auto decided = decide_regions(scan.cloud, {low, high, candidates[1], candidates[2], across},
                                      {low.centroid_m, 2}, {});
  EXPECT_EQ(decided.size(), 3u);
  EXPECT_TRUE(std::any_of(decided.begin(), decided.end(),
                          [&](const PlaneRegion& r) { return r.indices.size() == whole; }));
}

TEST(RegionDecision, LeavesRegionsThatReachOutOfTheBall) {
  const FewRows rows;
  const auto cells = detect_planes(rows.scan.cloud);
  const auto decided =
      decide_regions(rows.scan.cloud, cells, {rows.scan.cloud.positions[0], 0.05}, {});
  EXPECT_EQ(decided.size(), cells.size());
}

}  // namespace
}  // namespace alea
