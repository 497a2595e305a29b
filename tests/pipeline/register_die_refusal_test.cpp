#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "alea/pipeline/register_die.hpp"
#include "tests/support/die_scenes.hpp"

namespace alea {
namespace {

using testing::scan_twice;
using testing::TwoScans;
using testing::TwoStationCase;

void expect_refused(const TwoStationCase& scene_case, RefusalCode code, double edge_m = 0.5,
                    bool calibrate = false) {
  const TwoScans scans = scan_twice(scene_case);
  DieRegistrationOptions options;
  options.edge_m = edge_m;
  options.calibrate = calibrate;
  const Registration result = register_die(scans.master, scans.slave, options);
  EXPECT_FALSE(result.master_from_slave);
  ASSERT_TRUE(result.refusal);
  EXPECT_STREQ(to_string(result.refusal->code), to_string(code)) << result.refusal->message;
  EXPECT_FALSE(result.refusal->message.empty());
}

TEST(RegisterDieRefuses, ASceneWithoutADie) {
  TwoStationCase empty_room;
  empty_room.walls = true;
  empty_room.step_rad = 5e-3;
  empty_room.change_scene = [](Scene& scene, int) { scene.dice.clear(); };
  expect_refused(empty_room, RefusalCode::no_die);
}

TEST(RegisterDieRefuses, FewerThanThreeFacetsInAScan) {
  TwoStationCase frontal;
  frontal.change_die = [](DieModel& model, int scan) {
    // The slave looks straight at one side: top and one facet only.
    const double front = scan == 1 ? std::numbers::pi * 0.75 : 0;
    model.scene_from_die = standing_pose(model.chirality, 1, 2, front, {0, 0, 0.25});
  };
  expect_refused(frontal, RefusalCode::too_few_facets);
}

TEST(RegisterDieRefuses, ABlankCube) {
  TwoStationCase blank;
  blank.change_die = [](DieModel& model, int) { model.pips.painted = false; };
  expect_refused(blank, RefusalCode::pips_unreadable);
}

TEST(RegisterDieRefuses, ADieOfTheOtherHand) {
  TwoStationCase other;
  other.change_die = [](DieModel& model, int) {
    model.chirality = Chirality::counterclockwise;
    model.scene_from_die = standing_pose(model.chirality, 1, 2, 0, {0, 0, 0.25});
  };
  expect_refused(other, RefusalCode::chirality);
}

TEST(RegisterDieRefuses, AMirroredScan) {
  TwoStationCase mirrored;
  mirrored.change_die = [](DieModel& model, int scan) {
    if (scan == 0) return;
    model.chirality = Chirality::counterclockwise;
    model.scene_from_die = standing_pose(model.chirality, 1, 2, 0, {0, 0, 0.25});
  };
  expect_refused(mirrored, RefusalCode::mirrored);
}

TEST(RegisterDieRefuses, ADihedralFarFromARightAngle) {
  TwoStationCase skew;
  skew.change_die = [](DieModel& model, int) { model.facets[0].tilt_u_rad = 0.44; };  // 25 deg
  expect_refused(skew, RefusalCode::dihedral);
}

TEST(RegisterDieRefuses, AWrongSize) {
  expect_refused({}, RefusalCode::size_mismatch, 0.65);
}

TEST(RegisterDieRefuses, TooFewPoints) {
  TwoStationCase coarse;
  coarse.step_rad = 0.03;
  const TwoScans scans = scan_twice(coarse);
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  const Registration result = register_die(scans.master, scans.slave, options);
  EXPECT_FALSE(result.master_from_slave);
  ASSERT_TRUE(result.refusal);
}

TEST(RegisterDieRefuses, OneSharedFacetWithoutAShape) {
  TwoStationCase opposite;
  opposite.station_angle_rad = std::numbers::pi;
  expect_refused(opposite, RefusalCode::one_shared_facet);
}

TEST(RegisterDieRefuses, ToCalibrateOnNothing) {
  expect_refused({}, RefusalCode::unobservable, 0.5, true);
}

TwoStationCase two_like_dice() {
  TwoStationCase dice;
  dice.window_m = 1.8;
  dice.change_scene = [](Scene& scene, int) {
    DieModel copy = scene.dice.front().model;
    copy.scene_from_die.translation += Eigen::Vector3d(0.1, -1.2, 0);
    scene.dice.push_back(build_die(copy));
  };
  return dice;
}

TEST(RegisterDieRefuses, TwoLikeDiceOfWhichTheOtherScanShowsOne) {
  TwoStationCase dice = two_like_dice();
  const auto add_copy = dice.change_scene;
  dice.change_scene = [add_copy](Scene& scene, int scan) {
    if (scan == 1) add_copy(scene, scan);
  };
  expect_refused(dice, RefusalCode::ambiguous_target);
}

TEST(RegisterDie, ACuboidWhosePipsAreAsFarApartBothWays) {
  TwoStationCase cuboid;
  cuboid.window_m = 0.5;
  cuboid.change_die = [](DieModel& model, int) { model.size_m = {0.3, 0.5, 0.4}; };
  const TwoScans scans = scan_twice(cuboid);
  DieRegistrationOptions options;
  options.edges_m = {0.5, 0.3, 0.4};
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  const Vector6d error =
      left_difference(scans.master_from_slave, *result.master_from_slave, Eigen::Vector3d::Zero());
  EXPECT_LT(error.head<3>().norm(), 0.003);
  EXPECT_LT(error.tail<3>().norm(), 0.02);
}

TEST(RegisterDie, RepeatedPointsAreCountedOnceAndSaidSo) {
  const TwoScans scans = scan_twice({});
  Cloud twice = scans.master;
  twice.positions.insert(twice.positions.end(), scans.master.positions.begin(),
                         scans.master.positions.end());
  twice.intensity.insert(twice.intensity.end(), scans.master.intensity.begin(),
                         scans.master.intensity.end());
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  const Registration once = register_die(scans.master, scans.slave, options);
  const Registration result = register_die(twice, scans.slave, options);
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  EXPECT_EQ(result.covariance->covariance, once.covariance->covariance);
  ASSERT_EQ(result.warnings.size(), once.warnings.size() + 1);
  EXPECT_TRUE(result.warnings[0].starts_with("duplicate_points: master")) << result.warnings[0];
}

TEST(RegisterDieRefuses, AScanThatIsMirroredWhateverHandIsAllowed) {
  TwoScans scans = scan_twice({});
  for (Eigen::Vector3d& p : scans.slave.positions) p.y() = -p.y();
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  options.chirality.reset();
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_TRUE(result.refusal);
  EXPECT_EQ(result.refusal->code, RefusalCode::mirrored);
}

TEST(RegisterDie, TwoLikeDiceInBothScansArePairedByEachOther) {
  const TwoScans scans = scan_twice(two_like_dice());
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  const Vector6d error =
      left_difference(scans.master_from_slave, *result.master_from_slave, Eigen::Vector3d::Zero());
  EXPECT_LT(error.head<3>().norm(), 0.003);
  EXPECT_LT(error.tail<3>().norm(), 0.02);
}

}  // namespace
}  // namespace alea
