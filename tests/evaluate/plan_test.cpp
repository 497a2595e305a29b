#include "alea/evaluate/plan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/evaluate/die_positions.hpp"
#include "alea/evaluate/error_map.hpp"
#include "alea/evaluate/plan_check.hpp"
#include "alea/evaluate/plan_file.hpp"
#include "alea/simulate/scene_file.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

/// The geometry of the bound: a cube on the floor, two stations 45 deg off its facets.
Scene bound_scene(double edge_m, double range_m, double step_rad = 3e-4) {
  Scene scene;
  DieModel model;
  model.size_m.setConstant(edge_m);
  model.scene_from_die =
      standing_pose(Chirality::clockwise, 1, 2, 0, Eigen::Vector3d(0, 0, edge_m / 2));
  scene.dice = {build_die(model)};
  DieBoundCase geometry;
  geometry.edge_m = edge_m;
  geometry.range_m = range_m;
  for (const FisherStation& station : die_bound_scene(geometry).stations) {
    scene.stations.push_back(
        aimed_station(station.scene_from_scan, bounding_ball(scene.dice[0]), step_rad));
    scene.stations.back().name = "station " + std::to_string(scene.stations.size());
  }
  return scene;
}

TEST(Plan, IsTheBoundForWholeFacetsInFreeField) {
  for (const bool known : {true, false}) {
    PlanAssumptions assumptions;
    assumptions.shape_known = known;
    const auto pairs = plan_pairs(bound_scene(0.5, 6), assumptions);
    ASSERT_EQ(pairs.size(), 1u);
    ASSERT_TRUE(pairs[0].covariance);
    DieBoundCase geometry;
    geometry.shape_known = known;
    const PoseAccuracy bound = die_bound(geometry), plan = pose_accuracy(*pairs[0].covariance);
    EXPECT_NEAR(plan.rotation_rad / bound.rotation_rad, 1, 1e-6);
    EXPECT_NEAR(plan.ring10_m / bound.ring10_m, 1, 1e-6);
  }
}

TEST(Plan, ReachesTheRangesOfTheDieStudy) {
  struct Row {
    double edge_m;
    bool known;
    double range_m;
  };
  for (const Row& row :
       {Row{0.5, false, 12.5}, Row{0.3, false, 6.1}, Row{0.5, true, 21.6}, Row{0.3, true, 8.5}}) {
    PlanAssumptions assumptions;
    assumptions.shape_known = row.known;
    const auto range = reach_m(bound_scene(row.edge_m, 4), assumptions, {});
    ASSERT_TRUE(range);
    EXPECT_NEAR(*range / row.range_m, 1, 0.05) << row.edge_m << " m";
  }
}

TEST(Plan, FurnitureInTheLineOfSightCosts) {
  Scene scene = bound_scene(0.5, 6);
  const double before = ring_error_m(*plan_pairs(scene, {})[0].covariance, 10);
  Box box;
  box.size_m = {0.15, 0.15, 0.5};
  box.scene_from_box.translation =
      0.5 * scene.stations[0].scene_from_scan.translation + Eigen::Vector3d(0, 0, 0.1);
  scene.boxes = {box};
  const double after = ring_error_m(*plan_pairs(scene, {})[0].covariance, 10);
  EXPECT_GT(after, 1.1 * before);
  scene.boxes[0].size_m = {3, 3, 3};
  EXPECT_FALSE(plan_pairs(scene, {})[0].covariance) << "nothing of the die is seen any more";
}

TEST(Plan, BordersAndPipsLeftOutCostWhatTheirAreaSays) {
  Scene scene = bound_scene(0.5, 6);
  PlanAssumptions fitted;
  fitted.fitted_facets = true;
  const double ratio = ring_error_m(*plan_pairs(scene, fitted)[0].covariance, 10) /
                       ring_error_m(*plan_pairs(scene, {})[0].covariance, 10);
  // (l / (l - 2 t))^2 = 1.085 for the border; the pips take up to a sixth of a facet.
  EXPECT_GT(ratio, 1.085);
  EXPECT_LT(ratio, 1.25);
}

TEST(Plan, AStationAcrossWithoutAShapeIsRefused) {
  Scene scene = bound_scene(0.5, 6);
  scene.stations[1].scene_from_scan.translation.head<2>() =
      -scene.stations[0].scene_from_scan.translation.head<2>();
  PlanAssumptions anywhere;
  anywhere.within_windows = false;
  const auto pairs = plan_pairs(scene, anywhere);
  ASSERT_FALSE(pairs[0].covariance);
  EXPECT_EQ(pairs[0].covariance.refusal().code, RefusalCode::unobservable);
  anywhere.shape_known = true;
  EXPECT_TRUE(plan_pairs(scene, anywhere)[0].covariance);
}

TEST(Plan, AWindowThatMissesTheDieIsAnOpenPose) {
  Scene scene = bound_scene(0.5, 6);
  scene.stations[1].azimuth.start_rad += 0.5;
  scene.stations[1].azimuth.stop_rad += 0.5;
  EXPECT_FALSE(plan_pairs(scene, {})[0].covariance);
}

TEST(Plan, ADieThatNoStationSeesIsAnOpenPose) {
  Scene scene = bound_scene(0.5, 6);
  for (Station& station : scene.stations) station.elevation = {1.0, 1.2, 1e-3};
  EXPECT_FALSE(plan_pairs(scene, {})[0].covariance);
}

TEST(Plan, CountsThePointsOfEachFacet) {
  const Scene scene = bound_scene(0.5, 6, 1e-3);
  const auto facets = planned_facets(scene, {});
  ASSERT_EQ(facets.size(), 6u);
  double points = 0;
  for (const PlannedFacet& facet : facets)
    if (facet.station == 0) points += facet.points;
  // The die study has 0.5 m at 6 m with about 100,000 points at 0.3 mrad.
  EXPECT_NEAR(points, 9000, 2500);
}

TEST(ErrorMap, IsTheRmsOfDisplacedPoints) {
  TransformCovariance covariance;
  covariance.about_m = {1, 2, 0.5};
  covariance.covariance.diagonal() << 1e-8, 4e-8, 9e-8, 1e-6, 4e-6, 9e-6;
  EXPECT_NEAR(point_error_m(covariance, covariance.about_m), std::sqrt(14e-6), 1e-12);
  const Eigen::Vector3d lever(3, -4, 2);
  // var of w x p: (wy pz - wz py, wz px - wx pz, wx py - wy px)
  const double rotation = 4e-8 * 4 + 9e-8 * 16 + 9e-8 * 9 + 1e-8 * 4 + 1e-8 * 16 + 4e-8 * 9;
  EXPECT_NEAR(point_error_m(covariance, covariance.about_m + lever), std::sqrt(14e-6 + rotation),
              1e-12);
}

TEST(ErrorMap, GrowsFromTheDieOutwards) {
  const Scene scene = bound_scene(0.5, 6);
  const MapArea area = area_of(scene);
  const ErrorMap map = error_map(*plan_pairs(scene, {})[0].covariance,
                                 scene.stations[0].scene_from_scan.inverse(), area);
  ASSERT_EQ(map.error_m.size(), static_cast<std::size_t>(area.columns() * area.rows()));
  EXPECT_LT(map.root_mean_square_m(), map.largest_m());
  EXPECT_EQ(map.share_within(map.largest_m()), 1);
  EXPECT_EQ(map.share_within(0), 0);
}

TEST(DiePositions, FreePlacesStandClearAndTheBestIsNotWorseThanThePresent) {
  const Scene scene = load_scene(testing::source_dir() + "/datasets/die/site.toml");
  const MapArea area = area_of(scene);
  const auto places = free_floor_positions(scene, area, 2);
  ASSERT_GT(places.size(), 10u);
  for (const Eigen::Vector3d& place : places) {
    EXPECT_GT((place - Eigen::Vector3d(-3, 3, place.z())).norm(), 0.3) << "in the column";
    for (const Station& station : scene.stations)
      EXPECT_GT((station.scene_from_scan.translation - place).head<2>().norm(), 1 - 1e-9);
  }
  const Eigen::Vector3d now = bounding_ball(scene.dice[0]).centre_m;
  const auto ranked =
      rank_die_positions(scene, {}, area, {now, now + Eigen::Vector3d(-4, -1, 0)}, {0.0, 30 * deg});
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_FALSE(ranked[0].refusal);
  EXPECT_LE(ranked[0].room_rms_m, ranked[1].room_rms_m);
}

TEST(PlanFile, ReadsTheTableAndNamesWhatIsWrong) {
  const testing::TemporaryFolder folder;
  const auto load = [&](const std::string& plan) {
    const std::string path = folder.file("scene.toml");
    std::ofstream(path) << "[plan]\n"
                        << plan
                        << "\n[[station]]\nposition_m = [0, 0, 1]\n[[station]]\n"
                           "position_m = [3, 0, 1]\n";
    const Scene scene = load_scene(path);
    return load_plan(path, scene);
  };
  const PlanRequest request = load(
      "tolerance_m = 0.001\nshape = \"known\"\ntargets = [\"dice\"]\nlevel_sd_arcsec = 3\n"
      "[[plan.position]]\ncentre_m = [1, 2, 0.25]");
  EXPECT_EQ(request.tolerance_m, 0.001);
  EXPECT_TRUE(request.assumptions.shape_known);
  EXPECT_FALSE(request.assumptions.planes);
  EXPECT_NEAR(request.assumptions.level_sd_rad, 3 / 3600.0 * deg, 1e-12);
  ASSERT_EQ(request.positions_m.size(), 1u);
  for (const char* wrong : {"tolerance_m = -1", "shape = \"round\"", "targets = [\"walls\"]",
                            "heigth_m = 2", "y_m = [-1e6, 1e6]", "x_m = [1, 1]"})
    EXPECT_THROW(load(wrong), Error) << wrong;
}

TEST(PlanCheck, OffsetsOfARightPlanScatterAsForetold) {
  TransformCovariance covariance;
  covariance.covariance.diagonal() << 1e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8;
  CheckPlane plane;
  plane.id = 3;
  plane.centroid_m = {5, 0, 0};
  plane.normal = Eigen::Vector3d::UnitY();
  plane.offset_m = 4e-4;
  plane.points_master = plane.points_slave = 100;
  plane.alone_master_m = plane.alone_slave_m = 1e-3;
  CheckPlane calibration = plane;
  calibration.role = CheckPlaneRole::calibration;
  const auto checks = check_plan(covariance, {plane, calibration});
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].id, 3);
  // Translation, rotation about z times 5 m, and two means of 100 points of 1 mm.
  EXPECT_NEAR(checks[0].predicted_sd_m, std::sqrt(1e-8 + 25e-8 + 2e-8), 1e-9);
}

}  // namespace
}  // namespace alea
