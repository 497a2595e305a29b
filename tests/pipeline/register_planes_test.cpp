#include "alea/pipeline/register_planes.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "alea/pipeline/plane_solution.hpp"
#include "alea/pipeline/register_die.hpp"
#include "tests/support/die_scenes.hpp"
#include "tests/support/named_scenes.hpp"

namespace alea {
namespace {

double rotation_error_rad(const Registration& registration, const RigidTransform& truth) {
  return rotation_angle_rad(registration.master_from_slave->rotation * truth.rotation.transpose());
}

/// Both scans of a hall with four walls, one slanted: made once.
const testing::TwoScans& hall() {
  static const testing::TwoScans scans =
      testing::scan_twice({.range_m = 3, .step_rad = 5.5e-3, .walls = true});
  return scans;
}

TEST(RegisterPlanes, FindsTheTransformWithoutAnInitialOne) {
  const Registration found = register_planes(hall().master, hall().slave, {});
  ASSERT_TRUE(found.master_from_slave) << found.refusal->message;
  EXPECT_LT(rotation_error_rad(found, hall().master_from_slave), 1e-3);
  const Vector6d error = left_difference(hall().master_from_slave, *found.master_from_slave,
                                         found.covariance->about_m);
  // Six degrees of freedom: chi-square beyond 30 comes once in 25,000.
  EXPECT_LT(error.dot(found.covariance->covariance.inverse() * error), 30);
  EXPECT_FALSE(found.warnings.empty()) << "every plane took part";
  for (const CheckPlane& plane : found.check_planes)
    EXPECT_EQ(plane.role, CheckPlaneRole::calibration);
}

TEST(RegisterPlanes, StartsFromAnInitialTransformToTheSameBitsInAnyOrder) {
  PlaneRegistrationOptions options;
  options.initial =
      perturb_left(hall().master_from_slave,
                   (Vector6d() << 0.01, -0.01, 0.01, 0.03, 0.02, -0.03).finished(), {0, 0, 0});
  const Registration a = register_planes(hall().master, hall().slave, options);
  const Registration b = register_planes(testing::shuffled(hall().master, 3).cloud,
                                         testing::shuffled(hall().slave, 4).cloud, options);
  ASSERT_TRUE(a.master_from_slave && b.master_from_slave);
  EXPECT_EQ(a.master_from_slave->matrix(), b.master_from_slave->matrix());
  EXPECT_LT(rotation_error_rad(a, hall().master_from_slave), 1e-3);
}

TEST(RegisterPlanes, ANamedCheckPlaneTakesNoPart) {
  const Registration all = register_planes(hall().master, hall().slave, {});
  ASSERT_GE(all.check_planes.size(), 5u);
  PlaneRegistrationOptions options;
  options.check_plane_centroids_m = {all.check_planes[1].centroid_m};
  const Registration held = register_planes(hall().master, hall().slave, options);
  ASSERT_TRUE(held.master_from_slave) << held.refusal->message;
  EXPECT_EQ(std::count_if(held.check_planes.begin(), held.check_planes.end(),
                          [](const CheckPlane& p) { return p.role == CheckPlaneRole::check; }),
            1);
  EXPECT_NE(held.master_from_slave->matrix(), all.master_from_slave->matrix());
  EXPECT_TRUE(held.warnings.empty());
}

TEST(RegisterPlanes, RefusesPlanesThatDoNotSpanSpace) {
  testing::TwoStationCase bare{.range_m = 3, .step_rad = 6e-3, .walls = true};
  bare.change_scene = [](Scene& scene, int) {
    scene.dice.clear();
    // Floor and the two walls that face each other: nothing stops a shift along them.
    std::erase_if(scene.patches,
                  [](const Patch& patch) { return patch.id == "wall x" || patch.id == "slanted"; });
  };
  const testing::TwoScans scans = testing::scan_twice(bare);
  PlaneRegistrationOptions options;
  options.initial = scans.master_from_slave;
  const Registration found = register_planes(scans.master, scans.slave, options);
  ASSERT_TRUE(found.refusal);
  EXPECT_EQ(found.refusal->code, RefusalCode::unobservable);
}

TEST(RegisterPlanes, RefusesARoomThatLooksTheSameTurned) {
  testing::TwoStationCase box{.range_m = 3, .step_rad = 8e-3, .walls = true};
  box.change_scene = [](Scene& scene, int) {
    scene.dice.clear();
    scene.patches.clear();
    scene.patches.push_back({"floor", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}});
    scene.patches.push_back({"-x", {-4, -4, 0}, {0, 8, 0}, {0, 0, 3}});
    scene.patches.push_back({"+x", {4, -4, 0}, {0, 8, 0}, {0, 0, 3}});
    scene.patches.push_back({"-y", {-4, -4, 0}, {8, 0, 0}, {0, 0, 3}});
    scene.patches.push_back({"+y", {-4, 4, 0}, {8, 0, 0}, {0, 0, 3}});
  };
  const testing::TwoScans scans = testing::scan_twice(box);
  const Registration found = register_planes(scans.master, scans.slave, {});
  ASSERT_TRUE(found.refusal);
  EXPECT_EQ(found.refusal->code, RefusalCode::ambiguous_target);
}

TEST(RegisterPlanes, TwoThatHaveNoPlanesInCommonDoNotMatch) {
  testing::TwoStationCase nothing{.range_m = 3, .step_rad = 6e-3};
  nothing.change_scene = [](Scene& scene, int) {
    scene.dice.clear();
    scene.spheres.push_back({"ball", {0, 0, 0.25}, 0.4});
  };
  const testing::TwoScans scans = testing::scan_twice(nothing);
  const Registration found = register_planes(scans.master, scans.slave, {});
  ASSERT_TRUE(found.refusal);
  EXPECT_EQ(found.refusal->code, RefusalCode::no_match);
}

/// Registers the hall by its die and refines.
Registration refined(Refinement refinement) {
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  options.refine = refinement;
  return register_die(hall().master, hall().slave, options);
}

TEST(Refine, PlanesAndIcpComeNearerToTheTruthThanTheDie) {
  const Registration die = refined(Refinement::none);
  ASSERT_TRUE(die.master_from_slave) << die.refusal->message;
  EXPECT_FALSE(die.refinement);
  for (const Refinement refinement : {Refinement::planes, Refinement::icp}) {
    const Registration better = refined(refinement);
    ASSERT_TRUE(better.refinement) << to_string(refinement);
    EXPECT_EQ(better.refinement->method, to_string(refinement));
    EXPECT_LT(rotation_error_rad(better, hall().master_from_slave),
              rotation_error_rad(die, hall().master_from_slave))
        << to_string(refinement);
    const RigidTransform change = *better.master_from_slave * die.master_from_slave->inverse();
    EXPECT_NEAR(better.refinement->rotation_rad, rotation_angle_rad(change.rotation), 1e-12);
    // Of the rotation.
    EXPECT_LT(better.covariance->covariance.diagonal().head(3).sum(),
              die.covariance->covariance.diagonal().head(3).sum());
  }
}

TEST(Refine, CheckPlanesAreNotTouched) {
  const Registration by_planes = refined(Refinement::planes);
  const auto of_role = [&](CheckPlaneRole role) {
    return static_cast<std::size_t>(
        std::count_if(by_planes.check_planes.begin(), by_planes.check_planes.end(),
                      [role](const CheckPlane& plane) { return plane.role == role; }));
  };
  ASSERT_TRUE(by_planes.refinement);
  EXPECT_EQ(by_planes.refinement->planes, of_role(CheckPlaneRole::calibration));
  EXPECT_GT(of_role(CheckPlaneRole::check), 0u);
}

TEST(Refine, PlanesThatCannotCarryItLeaveTheDiesTransformWithAWarning) {
  testing::TwoStationCase floor_only{.range_m = 3, .step_rad = 4e-3, .walls = true};
  floor_only.change_scene = [](Scene& scene, int) {
    std::erase_if(scene.patches, [](const Patch& patch) { return patch.id != "floor"; });
  };
  const testing::TwoScans scans = testing::scan_twice(floor_only);
  DieRegistrationOptions options;
  options.edge_m = 0.5;
  const Registration die = register_die(scans.master, scans.slave, options);
  options.refine = Refinement::planes;
  const Registration same = register_die(scans.master, scans.slave, options);
  ASSERT_TRUE(die.master_from_slave && same.master_from_slave);
  EXPECT_EQ(same.master_from_slave->matrix(), die.master_from_slave->matrix());
  EXPECT_FALSE(same.refinement);
  EXPECT_TRUE(std::any_of(same.warnings.begin(), same.warnings.end(),
                          [](const std::string& w) { return w.starts_with("not_refined"); }));
}

}  // namespace
}  // namespace alea
