#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/pipeline/calibrate_shape.hpp"
#include "alea/pipeline/register_die.hpp"
#include "tests/pipeline/with_edge.hpp"
#include "tests/support/die_scenes.hpp"

namespace alea {
namespace {

using testing::scan_twice;
using testing::TwoScans;
using testing::TwoStationCase;

bool warns(const Registration& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const std::string& warning) { return warning.starts_with(code + ":"); });
}

/// The master and slaves at these angles from it.
struct Ring {
  Cloud master;
  std::vector<Cloud> slaves;
  std::vector<RigidTransform> master_from_slave;
};

Ring ring(const std::vector<double>& angles_deg) {
  Ring out;
  for (std::size_t k = 0; k < angles_deg.size(); ++k) {
    TwoStationCase scene;
    scene.station_angle_rad = angles_deg[k] * deg;
    scene.step_rad = 2e-3;
    TwoScans scans = scan_twice(scene, k);
    if (k == 0) out.master = std::move(scans.master);
    out.slaves.push_back(std::move(scans.slave));
    out.master_from_slave.push_back(scans.master_from_slave);
  }
  return out;
}

TEST(RegisterDieTogether, AnOppositeStationIsTiedByThoseBetween) {
  const Ring stations = ring({90, 180, -90});
  const auto alone = register_die(stations.master, stations.slaves[1], with_edge(0.5));
  ASSERT_TRUE(alone.refusal);
  EXPECT_EQ(alone.refusal->code, RefusalCode::one_shared_facet);
  const auto results = register_die(stations.master, stations.slaves, with_edge(0.5));
  ASSERT_EQ(results.size(), 3u);
  for (std::size_t k = 0; k < results.size(); ++k) {
    ASSERT_FALSE(results[k].refusal) << results[k].refusal->message;
    const TransformCovariance& covariance = *results[k].covariance;
    const Vector6d error = left_difference(stations.master_from_slave[k],
                                           *results[k].master_from_slave, covariance.about_m);
    EXPECT_LT(error.dot(covariance.covariance.ldlt().solve(error)), 27.9) << k;  // 99.99 %
    ASSERT_TRUE(results[k].adjustment);
    EXPECT_EQ(results[k].adjustment->scans, 4u);
    EXPECT_EQ(results[k].adjustment->defect, 0);
  }
}

TEST(RegisterDieTogether, AFacetOfAnotherBoxIsSuspect) {
  TwoStationCase scene;
  scene.change_die = [](DieModel& model, int scan) {
    if (scan == 1) model.facets[0].tilt_u_rad = 2 * deg;
  };
  const TwoScans scans = scan_twice(scene);
  DieRegistrationOptions options;
  options.shape.emplace();
  for (int f = 0; f < 6; ++f) options.shape->facets[f] = scans.die.body.planes[f];
  const Registration result = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(result.refusal);
  EXPECT_TRUE(warns(result, "facet_suspect"));
  // It leans towards one neighbour only, which could as well lean towards it.
  for (const FacetTest& test : result.adjustment->tests) {
    const bool certain = test.pips == 1 || test.scan == 0;
    if (certain) {
      EXPECT_EQ(test.suspect, test.scan == 1) << test.scan << " " << test.pips;
    }
  }
}

TEST(RegisterDieTogether, AShiftedFacetIsSuspectWhereTheSceneStandsWitness) {
  TwoStationCase scene;
  scene.walls = true;
  scene.step_rad = 3e-3;
  scene.change_die = [](DieModel& model, int scan) {
    if (scan == 1) model.facets[0].offset_m = 0.01;
  };
  const TwoScans scans = scan_twice(scene);
  const Registration result = register_die(scans.master, scans.slave, with_edge(0.5));
  ASSERT_FALSE(result.refusal);
  EXPECT_TRUE(warns(result, "facet_suspect"));
  scene.change_die = nullptr;
  const TwoScans clean = scan_twice(scene);
  EXPECT_FALSE(warns(register_die(clean.master, clean.slave, with_edge(0.5)), "facet_suspect"));
}

TEST(RegisterDieTogether, PlanesOfTheSceneTakePartWhereAsked) {
  TwoStationCase scene;
  scene.walls = true;
  scene.step_rad = 3e-3;
  const TwoScans scans = scan_twice(scene);
  DieRegistrationOptions options = with_edge(0.5);
  const Registration plain = register_die(scans.master, scans.slave, options);
  options.join_planes = true;
  const Registration joined = register_die(scans.master, scans.slave, options);
  ASSERT_FALSE(plain.refusal || joined.refusal);
  EXPECT_LT(joined.covariance->covariance.diagonal().head<3>().sum(),
            plain.covariance->covariance.diagonal().head<3>().sum());
  EXPECT_GT(joined.adjustment->freedom, plain.adjustment->freedom);
}

TEST(CalibrateShape, ARingGivesAnglesAndNoLengths) {
  const Ring stations = ring({90, 180, -90});
  std::vector<Cloud> scans{stations.master};
  scans.insert(scans.end(), stations.slaves.begin(), stations.slaves.end());
  ShapeCalibrationOptions options;
  options.die = with_edge(0.5);
  const auto open = calibrate_shape(scans, options);
  ASSERT_TRUE(open) << open.refusal().message;
  EXPECT_EQ(open->adjusted.defect, 2);
  EXPECT_EQ(open->adjusted.open.size(), 2u);
  EXPECT_FALSE(open->adjusted.shape.facets[5]);
  for (const AdjustedEdge& edge : open->adjusted.edges) EXPECT_FALSE(edge.length_m);
  for (const AdjustedAngle& angle : open->adjusted.angles) {
    ASSERT_TRUE(angle.angle_rad);
    EXPECT_LT(std::abs(*angle.angle_rad - std::numbers::pi / 2), 5 * *angle.sd_rad);
  }
  options.die.edge_sd_m = 2e-4;
  const auto measured = calibrate_shape(scans, options);
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->adjusted.defect, 0);
  EXPECT_FALSE(measured->adjusted.edges.empty());
  for (const AdjustedEdge& edge : measured->adjusted.edges) {
    ASSERT_TRUE(edge.length_m);
    EXPECT_NEAR(*edge.length_m, 0.5, 1e-3);
    EXPECT_LT(*edge.sd_m, 3e-4);
  }
}

}  // namespace
}  // namespace alea
