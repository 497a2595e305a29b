#include "alea/pipeline/register_die.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/shuffled_order.hpp"
#include "tests/pipeline/with_edge.hpp"
#include "tests/support/die_scenes.hpp"

namespace alea {
namespace {

using testing::scan_twice;
using testing::TwoScans;
using testing::TwoStationCase;

/// Squared Mahalanobis length of the error: chi-square with 6 degrees of freedom where the
/// covariance is true.
double normalised_error(const Registration& result, const TwoScans& scans) {
  const Vector6d error = left_difference(scans.master_from_slave, *result.master_from_slave,
                                         result.covariance->about_m);
  return error.dot(result.covariance->covariance.ldlt().solve(error));
}

void expect_close_to_truth(const Registration& result, const TwoScans& scans) {
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  ASSERT_TRUE(result.covariance);
  // The 99.99 % point of chi-square with 6 degrees of freedom is 27.9; the noise of one fixed seed.
  EXPECT_LT(normalised_error(result, scans), 27.9);
}

Cloud shuffled(const Cloud& cloud) {
  const RandomStream stream({5, 0, 0, 0, Purpose::test});
  return subset(cloud, experiments::shuffled_order(cloud.size(), stream));
}

TEST(RegisterDie, TwoSharedFacetsRegisterByTheLengthOfTheSharedEdge) {
  const TwoScans scans = scan_twice({});
  const Registration result = register_die(scans.master, scans.slave, with_edge(0.5));
  expect_close_to_truth(result, scans);
  EXPECT_EQ(result.method, "adjustment");
  ASSERT_TRUE(result.die && result.die->shared_edge);
  EXPECT_EQ(result.die->facets.size(), 6u);
  EXPECT_DOUBLE_EQ(*result.die->edge_m, 0.5);
  EXPECT_EQ(result.ambiguity->alternatives, 0);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings[0];
}

TEST(RegisterDie, NonOrthogonalDiceDoNotLeakIntoTheRotation) {
  TwoStationCase tilted;
  tilted.change_die = [](DieModel& model, int) {
    for (int k = 0; k < 6; ++k) model.facets[k] = {0.01 * (k - 2), 0.008 * (3 - k), 0, 0};
  };
  const TwoScans scans = scan_twice(tilted);
  DieRegistrationOptions options = with_edge(edge_length_m(scans.die.body, 1, 2));
  const Registration first = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(first.refusal);
  const std::string shared = *first.die->shared_edge;
  options.edge_m = edge_length_m(scans.die.body, shared[0] - '0', shared[2] - '0');
  expect_close_to_truth(register_die(scans.master, scans.slave, options), scans);
}

TEST(RegisterDie, ThreeSharedFacetsNeedNoLength) {
  TwoStationCase near_stations;
  near_stations.station_angle_rad = 0.5;
  const TwoScans scans = scan_twice(near_stations);
  const Registration exact = register_die(scans.master, scans.slave, with_edge(0.5));
  const Registration wrong = register_die(scans.master, scans.slave, with_edge(0.51));
  expect_close_to_truth(exact, scans);
  EXPECT_TRUE(exact.master_from_slave->matrix().isApprox(wrong.master_from_slave->matrix(), 1e-10));
}

/// Rotation error (rad) of a registration of a die whose facets are bowed.
double rotation_error_rad(const TwoScans& scans, FacetWeights weights) {
  DieRegistrationOptions options = with_edge(0.5);
  options.weights = weights;
  const Registration result = register_die(scans.master, scans.slave, options);
  EXPECT_FALSE(result.refusal);
  return left_difference(scans.master_from_slave, *result.master_from_slave,
                         result.covariance->about_m)
      .head<3>()
      .norm();
}

TEST(RegisterDie, AreaWeightsGiveWarpedFacetsOnePlaneFromBothStations) {
  TwoStationCase warped;
  warped.range_m = 3;
  warped.step_rad = 2e-3;
  warped.change_die = [](DieModel& model, int) {
    for (FacetShape& facet : model.facets) facet.bow_m = 0.005;
  };
  const TwoScans scans = scan_twice(warped);
  EXPECT_LT(rotation_error_rad(scans, FacetWeights::area),
            0.5 * rotation_error_rad(scans, FacetWeights::noise));
}

TEST(RegisterDie, RobustWeightsChangeLittleWithoutStrays) {
  const TwoScans scans = scan_twice({});
  EXPECT_NEAR(rotation_error_rad(scans, FacetWeights::robust),
              rotation_error_rad(scans, FacetWeights::noise), 2e-4);
}

TEST(RegisterDie, CalibrationFindsTheLengthOnPlanesThatDoNotCheck) {
  TwoStationCase room;
  room.walls = true;
  room.step_rad = 4e-3;
  room.range_m = 3;
  const TwoScans scans = scan_twice(room);
  DieRegistrationOptions options = with_edge(0.52);
  options.calibrate = true;
  const Registration result = register_die(scans.master, scans.slave, options);
  expect_close_to_truth(result, scans);
  EXPECT_TRUE(result.die->calibrated);
  EXPECT_NEAR(*result.die->edge_m, 0.5, 0.004);
  const auto calibrating =
      std::count_if(result.check_planes.begin(), result.check_planes.end(),
                    [](const auto& plane) { return plane.role == CheckPlaneRole::calibration; });
  EXPECT_EQ(calibrating, static_cast<std::ptrdiff_t>((result.check_planes.size() + 1) / 2));
  EXPECT_GE(result.check_planes.size(), 3u);
}

TEST(RegisterDie, ThePaperCalibratesOnItsCheckPlanesAndSaysSo) {
  TwoStationCase room;
  room.walls = true;
  room.step_rad = 4e-3;
  room.range_m = 3;
  const TwoScans scans = scan_twice(room);
  DieRegistrationOptions options = with_edge(0.52);
  options.method = DieMethod::paper;
  options.calibrate = true;
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  EXPECT_FALSE(result.covariance);
  EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(), [](const std::string& w) {
    return w.starts_with("circular_calibration");
  }));
  for (const CheckPlane& plane : result.check_planes) EXPECT_EQ(plane.role, CheckPlaneRole::check);
}

TEST(RegisterDie, SameBitsForAnyOrderOfThePointsAndAnyThreadCount) {
  const TwoScans scans = scan_twice({});
  const Registration once = register_die(scans.master, scans.slave, with_edge(0.5));
  const ThreadLimit one_thread(1);
  const Registration again =
      register_die(shuffled(scans.master), shuffled(scans.slave), with_edge(0.5));
  ASSERT_TRUE(once.master_from_slave && again.master_from_slave);
  EXPECT_EQ(once.master_from_slave->matrix(), again.master_from_slave->matrix());
  EXPECT_EQ(once.covariance->covariance, again.covariance->covariance);
}

TEST(RegisterDie, FarCoordinatesGiveTheSameAnswer) {
  TwoScans scans = scan_twice({});
  const Registration at_home = register_die(scans.master, scans.slave, with_edge(0.5));
  const Eigen::Vector3d far(5e5, -5e5, 5e5);
  for (Cloud* cloud : {&scans.master, &scans.slave}) {
    for (Eigen::Vector3d& p : cloud->positions) p += far;
    cloud->scanner_position = far;
  }
  const Registration away = register_die(scans.master, scans.slave, with_edge(0.5));
  ASSERT_TRUE(away.master_from_slave);
  const RigidTransform shift{Eigen::Matrix3d::Identity(), far};
  const RigidTransform back = shift.inverse() * *away.master_from_slave * shift;
  const Vector6d difference =
      left_difference(*at_home.master_from_slave, back, Eigen::Vector3d::Zero());
  EXPECT_LT(difference.head<3>().norm(), 1e-8);
  EXPECT_LT(difference.tail<3>().norm(), 1e-6);
}

TEST(RegisterDie, WithoutAScannerPositionTheOriginIsTriedAndThenOrthogonalFits) {
  TwoScans scans = scan_twice({});
  scans.master.scanner_position.reset();
  EXPECT_TRUE(register_die(scans.master, scans.slave, with_edge(0.5)).warnings.empty());
  for (Eigen::Vector3d& p : scans.master.positions) p += Eigen::Vector3d(5e5, 0, 0);
  const Registration result = register_die(scans.master, scans.slave, with_edge(0.5));
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_TRUE(result.warnings[0].starts_with("scanner_position_unknown"));
}

TEST(RegisterDie, ALengthThatTheFacetsContradictIsWarnedOf) {
  const TwoScans scans = scan_twice({});
  const Registration result = register_die(scans.master, scans.slave, with_edge(0.54));
  ASSERT_FALSE(result.refusal) << result.refusal->message;
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_TRUE(result.warnings[0].starts_with("edge_unverified"));
}

TEST(RegisterDie, AKnownShapeRegistersOppositeStations) {
  TwoStationCase opposite;
  opposite.station_angle_rad = 3.14159265358979;
  const TwoScans scans = scan_twice(opposite);
  DieRegistrationOptions options = with_edge(0.5);
  options.shape.emplace();
  for (int k = 0; k < 6; ++k) options.shape->facets[k] = scans.die.facets[k].plane;
  expect_close_to_truth(register_die(scans.master, scans.slave, options), scans);
  options.shape.reset();
  options.tilt_prior_rad = 0.005;
  expect_close_to_truth(register_die(scans.master, scans.slave, options), scans);
}

TEST(RegisterDie, ACloudWithoutIntensityIsBadInput) {
  TwoScans scans = scan_twice({});
  scans.slave.intensity.clear();
  EXPECT_THROW(register_die(scans.master, scans.slave, with_edge(0.5)), Error);
}

}  // namespace
}  // namespace alea
