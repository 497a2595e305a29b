#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "alea/core/seed.hpp"
#include "alea/pipeline/register_die.hpp"
#include "tests/pipeline/with_edge.hpp"
#include "tests/support/die_scenes.hpp"

namespace alea {
namespace {

using testing::scan_twice;
using testing::TwoScans;
using testing::TwoStationCase;

bool warned_of(const Registration& result, const std::string& of) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const std::string& warning) { return warning.starts_with(of); });
}

void expect_code(const Registration& result, RefusalCode code) {
  EXPECT_FALSE(result.master_from_slave);
  ASSERT_TRUE(result.refusal);
  EXPECT_STREQ(to_string(result.refusal->code), to_string(code)) << result.refusal->message;
}

/// Within its covariance: the 99.99 % point of chi-square with 6 degrees of freedom is 27.9.
void expect_true(const Registration& result, const TwoScans& scans) {
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  const Vector6d error = left_difference(scans.master_from_slave, *result.master_from_slave,
                                         result.covariance->about_m);
  EXPECT_LT(error.dot(result.covariance->covariance.ldlt().solve(error)), 27.9);
}

TEST(RegisterDieOddScenes, AnEdgeThatIsAFifthOffIsRefused) {
  const TwoScans scans = scan_twice({});
  for (const double edge_m : {0.4, 0.6})
    for (const bool calibrate : {false, true}) {
      DieRegistrationOptions options = with_edge(edge_m);
      options.calibrate = calibrate;
      expect_code(register_die(scans.master, scans.slave, options), RefusalCode::size_mismatch);
    }
}

TEST(RegisterDieOddScenes, AnEdgeTenTimesTooLongIsNamedAsTheWrongSize) {
  const TwoScans scans = scan_twice({});
  const Registration result = register_die(scans.master, scans.slave, with_edge(5));
  expect_code(result, RefusalCode::size_mismatch);
  EXPECT_NE(result.refusal->message.find("0.5"), std::string::npos) << result.refusal->message;
}

TEST(RegisterDieOddScenes, PlanesOfTheSceneContradictAnEdgeAndAccuseNoFacet) {
  TwoStationCase room;
  room.walls = true;
  room.step_rad = 4e-3;
  room.range_m = 3;
  const TwoScans scans = scan_twice(room);
  const Registration wrong = register_die(scans.master, scans.slave, with_edge(0.515));
  ASSERT_FALSE(wrong.refusal) << wrong.refusal->message;
  EXPECT_TRUE(warned_of(wrong, "edge_unverified: the planes"));
  EXPECT_FALSE(warned_of(wrong, "facet_suspect"));
  const Registration right = register_die(scans.master, scans.slave, with_edge(0.5));
  expect_true(right, scans);
  EXPECT_FALSE(warned_of(right, "edge_unverified"));
}

TEST(RegisterDieOddScenes, PipsDeeperThanTheFacetsNoiseAreRead) {
  TwoStationCase drilled;
  drilled.step_rad = 3e-3;
  drilled.change_die = [](DieModel& model, int) { model.pips.recess_m = 0.01; };
  for (std::uint64_t trial = 0; trial < 4; ++trial) {
    const TwoScans scans = scan_twice(drilled, trial);
    expect_true(register_die(scans.master, scans.slave, with_edge(0.5)), scans);
  }
}

/// The same scan by a scanner with so much more noise along its rays.
Cloud noisier(Cloud cloud, double sd_m, std::uint32_t scan) {
  RandomStream stream({31, 0, 0, scan, Purpose::test});
  for (Eigen::Vector3d& p : cloud.positions) p += sd_m * stream.normal() * p.normalized();
  return cloud;
}

TEST(RegisterDieOddScenes, ANoisyScannerIsAskedWithAWiderTolerance) {
  const TwoScans scans = scan_twice({});
  const Registration result =
      register_die(noisier(scans.master, 0.012, 0), noisier(scans.slave, 0.012, 1), with_edge(0.5));
  expect_true(result, scans);
}

TEST(RegisterDieOddScenes, TwoFacetsBesideACrateAreTooFewAndNoWrongSize) {
  TwoStationCase frontal;
  frontal.window_m = 1.8;
  frontal.change_die = [](DieModel& model, int scan) {
    const double front = scan == 1 ? std::numbers::pi * 0.75 : 0;
    model.scene_from_die = standing_pose(model.chirality, 1, 2, front, {0, 0, 0.25});
  };
  frontal.change_scene = [](Scene& scene, int) {
    Box crate;
    crate.size_m = {0.62, 0.62, 0.62};
    crate.scene_from_box.translation = {0.1, -1.2, 0.31};
    scene.boxes.push_back(crate);
  };
  const TwoScans scans = scan_twice(frontal);
  expect_code(register_die(scans.master, scans.slave, with_edge(0.5)), RefusalCode::too_few_facets);
}

}  // namespace
}  // namespace alea
