#include "alea/pipeline/register_markerless.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "alea/io/cloud_file.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea {
namespace {

using experiments::markerless::pose_error;
using experiments::markerless::scan_twin;
using experiments::markerless::TwinOptions;
using experiments::markerless::TwinScans;

TwinOptions coarse_twin(bool bare) {
  TwinOptions options;
  options.layout = 1;
  options.bare = bare;
  options.step_rad = 12e-3;
  return options;
}

TEST(RegisterMarkerless, FindsOutdoorAndIndoorStationsOfTheTower) {
  const TwinScans scans = scan_twin(bell_tower(coarse_twin(false)), {0, 5, 6}, 1);
  for (const std::size_t moving : {std::size_t{1}, std::size_t{2}}) {
    const auto found = register_markerless(scans.clouds[0], scans.clouds[moving], {});
    ASSERT_TRUE(found.registration.master_from_slave) << found.registration.refusal->message;
    const auto error = pose_error(*found.registration.master_from_slave, scans.truth(0, moving));
    EXPECT_LT(error.rotation_deg, 0.2);
    EXPECT_LT(error.translation_m, 0.03);
    ASSERT_TRUE(found.registration.covariance);
    EXPECT_GT(found.registration.covariance->covariance(3, 3), 0);
  }
}

TEST(RegisterMarkerless, RefusesTheBareTowerAndCountsItsPoses) {
  const TwinScans scans = scan_twin(bell_tower(coarse_twin(true)), {5, 6}, 1);
  const auto found = register_markerless(scans.clouds[0], scans.clouds[1], {});
  ASSERT_TRUE(found.registration.refusal);
  EXPECT_EQ(found.registration.refusal->code, RefusalCode::ambiguous_target);
  EXPECT_GE(found.registration.ambiguity->alternatives, 3);
}

/// Stations around a lighthouse: their common points are ground but for a few, and those say where
/// the scans stand.
TwinScans around_the_lighthouse(std::uint64_t layout, double step_rad,
                                const std::vector<std::size_t>& stations) {
  TwinOptions options;
  options.layout = layout;
  options.step_rad = step_rad;
  return scan_twin(lighthouse(options), stations, layout);
}

TEST(RegisterMarkerless, RefinesToTheEndWhereFewSurfacesStand) {
  // Weights alone stopped 0.6 deg and 0.11 m off here, and the pose was reported.
  const TwinScans scans = around_the_lighthouse(5443, 5e-3, {0, 3});
  const auto found = register_markerless(scans.clouds[0], scans.clouds[1], {});
  ASSERT_TRUE(found.registration.master_from_slave) << found.registration.refusal->message;
  const auto error = pose_error(*found.registration.master_from_slave, scans.truth(0, 1));
  EXPECT_LT(error.rotation_deg, 0.05);
  EXPECT_LT(error.translation_m, 0.01);
}

TEST(RegisterMarkerless, AFewStandingPointsAreEnough) {
  // 0.24 % of the points at the true pose.
  const TwinScans scans = around_the_lighthouse(5443, 10e-3, {3, 7});
  const auto found = register_markerless(scans.clouds[0], scans.clouds[1], {});
  ASSERT_TRUE(found.registration.master_from_slave) << found.registration.refusal->message;
  EXPECT_TRUE(pose_error(*found.registration.master_from_slave, scans.truth(0, 1)).is_right());
}

TEST(RegisterMarkerless, FarFromTheOriginGivesTheSamePose) {
  const TwinScans scans = scan_twin(bell_tower(coarse_twin(false)), {5, 6}, 1);
  const Eigen::Vector3d far(5e5, -5e5, 100);
  const auto moved = [&](Cloud cloud) {
    for (Eigen::Vector3d& p : cloud.positions) p += far;
    cloud.scanner_position = far;
    return cloud;
  };
  const auto near_origin = register_markerless(scans.clouds[1], scans.clouds[0], {});
  const auto far_away = register_markerless(moved(scans.clouds[1]), moved(scans.clouds[0]), {});
  ASSERT_TRUE(near_origin.registration.master_from_slave);
  ASSERT_TRUE(far_away.registration.master_from_slave);
  const RigidTransform& a = *near_origin.registration.master_from_slave;
  RigidTransform b = *far_away.registration.master_from_slave;
  b.translation += b.rotation * far - far;
  EXPECT_LT((a.rotation - b.rotation).norm(), 1e-6);
  EXPECT_LT((a.translation - b.translation).norm(), 1e-5);
}

/// A real pair of ALEA_DATASETS with the reference of its SOURCE.md.
struct RealPair {
  std::string fixed, moving;
  std::array<double, 12> fixed_from_moving;  ///< row by row
  double rotation_deg, translation_m;        ///< what the reference can bear
};

void PrintTo(const RealPair& pair, std::ostream* out) {
  *out << pair.fixed << " and " << pair.moving;
}

class RealPairs : public ::testing::TestWithParam<RealPair> {};

TEST_P(RealPairs, AgreeWithTheirReferenceOrAreRefused) {
  const char* folder = std::getenv("ALEA_DATASETS");
  if (folder == nullptr) GTEST_SKIP() << "ALEA_DATASETS does not name the real scans";
  const RealPair& pair = GetParam();
  const std::filesystem::path root(folder);
  const auto found = register_markerless(read_cloud((root / pair.fixed).string()),
                                         read_cloud((root / pair.moving).string()), {});
  ASSERT_TRUE(found.registration.master_from_slave) << found.registration.refusal->message;
  RigidTransform reference;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      reference.rotation(i, j) = pair.fixed_from_moving[static_cast<std::size_t>(4 * i + j)];
    reference.translation[i] = pair.fixed_from_moving[static_cast<std::size_t>(4 * i + 3)];
  }
  const auto error = pose_error(*found.registration.master_from_slave, reference);
  EXPECT_LT(error.rotation_deg, pair.rotation_deg);
  EXPECT_LT(error.translation_m, pair.translation_m);
}

INSTANTIATE_TEST_SUITE_P(
    Datasets, RealPairs,
    ::testing::Values(RealPair{"room-scan-pair-pcl/room_scan1.pcd",
                               "room-scan-pair-pcl/room_scan2.pcd",
                               {0.756003, -0.654221, 0.021301, 1.9738, 0.654098, 0.756293, 0.013303,
                                0.0591, -0.024813, 0.003875, 0.999685, 0.0146},
                               1.5,
                               0.15},
                      RealPair{"outdoor-velodyne-libpointmatcher/car_cloud400.csv",
                               "outdoor-velodyne-libpointmatcher/car_cloud401.csv",
                               {0.982304, 0.166685, -0.0854066, 0.0446816, -0.150189, 0.973488,
                                0.172524, 0.191998, 0.111899, -0.156644, 0.981296, -0.0356313},
                               1.0,
                               0.15},
                      RealPair{
                          "outdoor-lidar-pair-gicp/small_gicp_target.ply",
                          "outdoor-lidar-pair-gicp/small_gicp_source.ply",
                          {0.999925, 0.0121483, -0.00177009, 0.488882, -0.0121523, 0.999924,
                           -0.00228657, 0.121214, 0.00174218, 0.00230791, 0.999996, -0.0253342},
                          0.6,
                          0.08},
                      RealPair{"factory-room-pandar64/1.pcd",
                               "factory-room-pandar64/8.pcd",
                               {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                               0.05,
                               0.01}));

}  // namespace
}  // namespace alea
