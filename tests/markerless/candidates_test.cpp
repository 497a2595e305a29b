#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/markerless/standing_agreement.hpp"
#include "alea/markerless/surface_map.hpp"
#include "alea/markerless/symmetry_axis.hpp"
#include "alea/markerless/yaw_sweep.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea {
namespace {

using experiments::markerless::pose_error;
using experiments::markerless::scan_twin;
using experiments::markerless::TwinOptions;
using experiments::markerless::TwinScans;

/// A wall in the plane x = 0, 4 m wide, that faces +x.
Cloud facing_wall() {
  Cloud cloud;
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j) {
      cloud.positions.emplace_back(0, 0.1 * i, 0.1 * j);
      cloud.normals.emplace_back(1, 0, 0);
    }
  return cloud;
}

TEST(SurfaceMap, FindsASurfaceNearbyThatFacesTheSameWay) {
  const SurfaceMap map(facing_wall(), 0.5);
  EXPECT_TRUE(map.has({0.24, 0.5, -0.3}, {1, 0, 0}));
  EXPECT_TRUE(map.has({-0.24, 0.5, -0.3}, Eigen::Vector3d(1, 0.5, 0).normalized()));
  EXPECT_FALSE(map.has({0.1, 0.5, -0.3}, {-1, 0, 0})) << "the other face of the wall";
  EXPECT_FALSE(map.has({0.1, 0.5, -0.3}, {0, 0, 1}));
  EXPECT_FALSE(map.has({0.8, 0.5, -0.3}, {1, 0, 0}));
  EXPECT_FALSE(map.has({0, 1e6, 0}, {1, 0, 0})) << "far outside of the map";
}

TEST(SurfaceMap, StaysSmallForWideClouds) {
  Cloud cloud = facing_wall();
  cloud.positions.emplace_back(5000, 5000, 100);
  cloud.normals.emplace_back(0, 0, 1);
  const SurfaceMap map(cloud, 0.5);
  EXPECT_TRUE(map.has({5000, 5000, 100}, {0, 0, 1}));
  EXPECT_TRUE(map.has({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(map.has({2500, 2500, 50}, {1, 0, 0}));
}

TEST(SurfaceMap, EmptyHasNothing) {
  EXPECT_FALSE(SurfaceMap(Cloud{}, 0.5).has({0, 0, 0}, {0, 0, 1}));
}

/// Rolling ground 1.6 m below a scanner, with a wall 3 m ahead where `with_wall` says so.
PreparedScan rolling_ground(bool with_wall) {
  Cloud cloud;
  for (double x = -8; x < 8; x += 0.1)
    for (double y = -8; y < 8; y += 0.1)
      cloud.positions.emplace_back(x, y, -1.6 + 0.15 * std::sin(0.7 * x) * std::cos(0.5 * y));
  for (double y = -3; with_wall && y < 3; y += 0.1)
    for (double z = -1.3; z < 2; z += 0.1) cloud.positions.emplace_back(3, y, z);
  return prepare_scan(cloud, {});
}

TEST(StandingEvidence, GroundOnTheGroundOfAnotherPlaceDoesNotStand) {
  const PreparedScan ground = rolling_ground(false);
  RigidTransform elsewhere;
  elsewhere.translation = {4, 1, 0};
  const StandingEvidence found = standing_evidence(ground, ground, elsewhere, {});
  EXPECT_GT(found.evidence.overlap(), 0.2);
  EXPECT_LT(found.standing, 0.01);
}

TEST(StandingEvidence, AWallOnItselfStandsAndRanksAboveTheGroundAlone) {
  const PreparedScan scan = rolling_ground(true);
  RigidTransform elsewhere;
  elsewhere.rotation =
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const StandingEvidence here = standing_evidence(scan, scan, {}, {});
  const StandingEvidence there = standing_evidence(scan, scan, elsewhere, {});
  EXPECT_GT(here.standing, 0.04);
  EXPECT_LT(there.standing, 0.01);
  EXPECT_LT(here.contradiction(), there.contradiction() / 2);
}

/// Layout 2023 of the tower, two opposite outdoor stations and an indoor one.
class TowerCandidates : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    TwinOptions options;
    options.layout = 2023;
    options.step_rad = 10e-3;
    scans_ = scan_twin(bell_tower(options), {0, 2, 5}, 2023);
    prepared_.clear();
    for (const Cloud& cloud : scans_.clouds) prepared_.push_back(prepare_scan(cloud, {}));
  }
  /// Is a pose within what ICP mends of the truth?
  static bool holds_truth(const std::vector<PoseCandidate>& candidates, std::size_t fixed,
                          std::size_t moving) {
    const RigidTransform truth = scans_.truth(fixed, moving);  // the scanners are the origins
    return std::any_of(candidates.begin(), candidates.end(), [&](const PoseCandidate& candidate) {
      const auto error = pose_error(candidate.fixed_from_moving, truth);
      return error.rotation_deg < 5 && error.translation_m < 0.7;
    });
  }
  static inline TwinScans scans_;
  static inline std::vector<PreparedScan> prepared_;
};

TEST_F(TowerCandidates, AxisOfTheTowerIsFoundFromOutsideAndInside) {
  for (std::size_t s = 0; s < prepared_.size(); ++s) {
    const Eigen::Vector3d truth = scans_.scene_from_scan[s].inverse() * Eigen::Vector3d(0, 0, 0);
    const auto axes = symmetry_axes(prepared_[s], 3);
    EXPECT_TRUE(std::any_of(axes.begin(), axes.end(), [&](const SymmetryAxis& axis) {
      return (axis.place_m - truth.head<2>()).norm() < 0.4;
    })) << scans_.names[s];
  }
}

TEST_F(TowerCandidates, YawSweepProposesTheIndoorStationSeenFromOutside) {
  EXPECT_TRUE(holds_truth(yaw_sweep(prepared_[0], prepared_[2], {}), 0, 2));
  EXPECT_TRUE(holds_truth(yaw_sweep(prepared_[1], prepared_[2], {}), 1, 2));
}

TEST_F(TowerCandidates, AxisSweepProposesStationsThatSeeOppositeSides) {
  EXPECT_TRUE(holds_truth(axis_sweep(prepared_[0], prepared_[1], {}), 0, 1));
}

}  // namespace
}  // namespace alea
