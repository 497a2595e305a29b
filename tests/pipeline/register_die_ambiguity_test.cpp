#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "alea/pipeline/register_die.hpp"
#include "tests/support/die_scenes.hpp"

namespace alea {
namespace {

using testing::scan_twice;
using testing::TwoScans;
using testing::TwoStationCase;

TwoStationCase blank_cube_in_a_room() {
  TwoStationCase room;
  room.walls = true;
  room.range_m = 3;
  room.step_rad = 4e-3;
  room.change_die = [](DieModel& model, int) { model.pips.painted = false; };
  return room;
}

DieRegistrationOptions cube_of_half_a_metre() {
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  return options;
}

double angle_to_truth(const RigidTransform& estimate, const TwoScans& scans) {
  return rotation_angle_rad(estimate.rotation * scans.master_from_slave.rotation.transpose());
}

TEST(RegisterBlankCube, IsRefusedWithAllOrientationsOfACube) {
  const TwoScans scans = scan_twice(blank_cube_in_a_room());
  const Registration result = register_die(scans.master, scans.slave, cube_of_half_a_metre());
  ASSERT_TRUE(result.refusal);
  EXPECT_EQ(result.refusal->code, RefusalCode::pips_unreadable);
  ASSERT_TRUE(result.ambiguity);
  EXPECT_EQ(result.ambiguity->alternatives, 23);
  ASSERT_EQ(result.ambiguity->orientations.size(), 24u);
  int near_truth = 0;
  for (const OrientationReport& each : result.ambiguity->orientations) {
    EXPECT_EQ(each.log_likelihood_margin, 0);
    if (angle_to_truth(each.master_from_slave, scans) < 0.02) ++near_truth;
  }
  EXPECT_EQ(near_truth, 1);
}

TEST(RegisterBlankCube, LevelledScannersLeaveFourOrientations) {
  const TwoScans scans = scan_twice(blank_cube_in_a_room());
  DieRegistrationOptions options = cube_of_half_a_metre();
  options.levelled = true;
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_TRUE(result.refusal);
  EXPECT_EQ(result.refusal->code, RefusalCode::pips_unreadable);
  ASSERT_TRUE(result.ambiguity);
  EXPECT_EQ(result.ambiguity->orientations.size(), 4u);
  EXPECT_EQ(result.ambiguity->alternatives, 3);
}

TEST(RegisterBlankCube, TheSceneResolvesItWhenAsked) {
  const TwoScans scans = scan_twice(blank_cube_in_a_room());
  DieRegistrationOptions options = cube_of_half_a_metre();
  options.resolve_by_scene = true;
  for (const DieMethod method : {DieMethod::closed_form, DieMethod::adjustment}) {
    options.method = method;
    const Registration result = register_die(scans.master, scans.slave, options);
    ASSERT_FALSE(result.refusal) << result.refusal->message;
    const TransformCovariance& covariance = *result.covariance;
    const Vector6d error =
        left_difference(scans.master_from_slave, *result.master_from_slave, covariance.about_m);
    EXPECT_LT(error.head<3>().norm(), 0.005);
    EXPECT_LT(error.tail<3>().norm(), 0.01);
    EXPECT_TRUE(result.ambiguity->resolved_by_scene);
    EXPECT_TRUE(std::any_of(
        result.warnings.begin(), result.warnings.end(),
        [](const std::string& warning) { return warning.starts_with("resolved_by_scene"); }));
    const auto& orientations = result.ambiguity->orientations;
    const auto best =
        std::max_element(orientations.begin(), orientations.end(),
                         [](const OrientationReport& a, const OrientationReport& b) {
                           return a.scene_points.value_or(0) < b.scene_points.value_or(0);
                         });
    EXPECT_LT(angle_to_truth(best->master_from_slave, scans), 0.02);
  }
}

TEST(RegisterBlankCube, ASceneThatLooksTheSameTurnedDoesNotResolveIt) {
  TwoStationCase square = blank_cube_in_a_room();
  square.change_scene = [](Scene& scene, int) {
    scene.patches.clear();
    scene.patches.push_back({"floor", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}});
  };
  const TwoScans scans = scan_twice(square);
  DieRegistrationOptions options = cube_of_half_a_metre();
  options.resolve_by_scene = true;
  options.levelled = true;
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_TRUE(result.refusal);
  EXPECT_EQ(result.refusal->code, RefusalCode::ambiguous_target);
}

TEST(RegisterBlankCube, FewerCommonPlanesContradictNoOrientation) {
  // In the middle of a square room, a quarter turn apart and seeing two walls each, of which they
  // share one: turned back by a quarter, the scans would share both.
  TwoStationCase square = blank_cube_in_a_room();
  square.walls = false;
  square.window_m = 1.5;
  square.change_scene = [](Scene& scene, int) {
    scene.patches.push_back({"floor", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}});
    for (const double side : {-4.0, 4.0}) {
      scene.patches.push_back({"wall x", {side, -4, 0}, {0, 8, 0}, {0, 0, 3}});
      scene.patches.push_back({"wall y", {-4, side, 0}, {8, 0, 0}, {0, 0, 3}});
    }
  };
  const TwoScans scans = scan_twice(square);
  DieRegistrationOptions options = cube_of_half_a_metre();
  options.resolve_by_scene = true;
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_TRUE(result.refusal);
  EXPECT_EQ(result.refusal->code, RefusalCode::ambiguous_target);
}

TEST(RegisterReadableDie, ListsTheOrientationsThatItRejectsAndNeedsNoScene) {
  TwoStationCase room = blank_cube_in_a_room();
  room.change_die = nullptr;
  const TwoScans scans = scan_twice(room);
  DieRegistrationOptions options = cube_of_half_a_metre();
  const Registration plain = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(plain.refusal);
  const auto& orientations = plain.ambiguity->orientations;
  ASSERT_EQ(orientations.size(), 24u);
  EXPECT_LT(angle_to_truth(orientations[0].master_from_slave, scans), 0.02);
  EXPECT_EQ(orientations[0].log_likelihood_margin, 0);
  EXPECT_EQ(orientations[1].log_likelihood_margin, plain.ambiguity->log_likelihood_margin);
  EXPECT_GT(orientations[1].log_likelihood_margin, 6);
  options.levelled = options.resolve_by_scene = true;
  const Registration asked = register_die(scans.master, scans.slave, options);
  EXPECT_EQ(asked.master_from_slave->matrix(), plain.master_from_slave->matrix());
  EXPECT_FALSE(asked.ambiguity->resolved_by_scene);
}

}  // namespace
}  // namespace alea
