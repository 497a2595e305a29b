#include "experiments/die/twin.hpp"

#include <gtest/gtest.h>

#include <set>

#include "alea/core/error.hpp"
#include "alea/simulate/scanner.hpp"

namespace alea::experiments::die {
namespace {

class TwinOf : public ::testing::TestWithParam<const char*> {};

std::set<int> facets_seen(const Twin& twin, int scan) {
  Scene scene;
  scene.dice.push_back(twin.die);
  Station station = aimed_station(twin.scene_from_scan[scan], bounding_ball(twin.die), 5e-3);
  std::set<int> seen;
  for (const PointTruth& point : simulate_scan_with_truth(scene, station, {}).truth)
    seen.insert(point.surface.facet);
  return seen;
}

TEST_P(TwinOf, ShowsEachScanTheFacetsOfTableOne) {
  const PublishedTables tables = load_published_tables();
  for (std::uint64_t trial = 0; trial < 8; ++trial) {
    const Twin twin = draw_twin(tables, GetParam(), {}, 1, trial);
    int scan = 0;
    for (const PublishedScan& row : tables.scans) {
      if (row.dataset != GetParam()) continue;
      EXPECT_EQ(facets_seen(twin, scan), std::set<int>(row.pips.begin(), row.pips.end()))
          << "trial " << trial << " scan " << scan;
      EXPECT_NEAR(
          (twin.scene_from_scan[scan].translation - Eigen::Vector3d(0, 0, twin.true_edge_m / 2))
              .norm(),
          row.scanner_to_die_m, 1e-9);
      ++scan;
    }
  }
}

TEST_P(TwinOf, HasTheEdgeOfTableSixAndThePointsOfTableOne) {
  const PublishedTables tables = load_published_tables();
  const Twin twin = draw_twin(tables, GetParam(), {}, 1, 3);
  EXPECT_NEAR(edge_length_m(twin.die.body, twin.top, twin.side), twin.true_edge_m, 1e-9);
  Scene scene;
  scene.dice.push_back(twin.die);
  int scan = 0;
  for (const PublishedScan& row : tables.scans) {
    if (row.dataset != GetParam()) continue;
    const Station station =
        aimed_station(twin.scene_from_scan[scan], bounding_ball(twin.die), twin.step_rad[scan]);
    const double points = static_cast<double>(simulate_scan(scene, station, {}).size());
    EXPECT_NEAR(points / parse_printed(row.points).value, 1, 0.03) << "scan " << scan;
    ++scan;
  }
}

TEST_P(TwinOf, PlacesTheCheckPlanesAtTheirPrintedDistancesWhereTheyCanMeet) {
  const PublishedTables tables = load_published_tables();
  for (std::uint64_t trial = 0; trial < 8; ++trial) {
    const Twin twin = draw_twin(tables, GetParam(), {}, 1, trial);
    ASSERT_EQ(twin.planes.size(), 8u);
    std::size_t k = 0;
    for (const PublishedCheckPlane& row : tables.check_planes) {
      if (row.dataset != GetParam()) continue;
      const TwinPlane& plane = twin.planes[k++];
      EXPECT_EQ(plane.name, row.plane);
      EXPECT_EQ(plane.vertical, row.vertical);
      if (!row.distance_die_m) continue;
      // The print of these breaks the triangle's inequality.
      const bool printed_apart = std::set<std::string>{"A-1", "A-3", "B-3"}.contains(row.plane);
      const Eigen::Vector3d centre = centre_of(plane.patch);
      EXPECT_NEAR((centre - Eigen::Vector3d(0, 0, twin.true_edge_m / 2)).norm(),
                  *row.distance_die_m, 0.02);
      // and B-3 break the triangle's inequality in print.
      EXPECT_NEAR((centre - twin.scene_from_scan[0].translation).norm(), *row.distance_station1_m,
                  printed_apart ? 0.9 : 0.55)
          << row.plane;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Datasets, TwinOf, ::testing::Values("A", "B", "C", "D"));

TEST(Twin, IsTheSameForTheSameKeyAndRefusesAnotherDataset) {
  const PublishedTables tables = load_published_tables();
  const Twin a = draw_twin(tables, "B", {}, 5, 2), b = draw_twin(tables, "B", {}, 5, 2);
  EXPECT_EQ(a.master_from_slave().matrix(), b.master_from_slave().matrix());
  EXPECT_EQ(a.step_rad, b.step_rad);
  EXPECT_NE(a.scanner_height_m, draw_twin(tables, "B", {}, 5, 3).scanner_height_m);
  EXPECT_THROW(draw_twin(tables, "E", {}, 1, 0), Error);
}

}  // namespace
}  // namespace alea::experiments::die
