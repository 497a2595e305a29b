#include "alea/evaluate/check_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

constexpr double sigma_m = 0.0015;

struct TestScan {
  Cloud cloud;
  std::vector<PlaneRegion> regions;
};

/// Adds a rectangle [0, width] x [0, height] spanned by u, v from a corner, with noise along the
/// normal.
void add_rectangle(TestScan& scan, RandomStream& stream, const Eigen::Vector3d& corner,
                   const Eigen::Vector3d& u, const Eigen::Vector3d& v, int points) {
  PlaneRegion region;
  const Eigen::Vector3d normal = u.cross(v).normalized();
  for (int i = 0; i < points; ++i) {
    region.indices.push_back(static_cast<std::uint32_t>(scan.cloud.size()));
    scan.cloud.positions.push_back(corner + stream.uniform() * u + stream.uniform() * v +
                                   sigma_m * stream.normal() * normal);
  }
  region.plane = {normal, normal.dot(corner)};
  region.centroid_m = corner + 0.5 * (u + v);
  scan.regions.push_back(region);
}

/// A wall at x = 4, a floor and a second wall 0.3 m behind the first, of which the slave sees a
/// part only.
TestScan room(std::uint32_t scan_number, double wall_from_y, const RigidTransform& scan_from_room) {
  RandomStream stream({21, 0, 0, scan_number, Purpose::test});
  TestScan scan;
  add_rectangle(scan, stream, {4, wall_from_y, 0}, {0, 3, 0}, {0, 0, 2}, 20000);
  add_rectangle(scan, stream, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 20000);
  add_rectangle(scan, stream, {4.3, 5, 0}, {0, 1, 0}, {0, 0, 2}, 3000);
  for (Eigen::Vector3d& p : scan.cloud.positions) p = scan_from_room * p;
  for (PlaneRegion& region : scan.regions) {
    region.centroid_m = scan_from_room * region.centroid_m;
    region.plane.normal = scan_from_room.rotation * region.plane.normal;
    region.plane.offset_m = region.plane.normal.dot(region.centroid_m);
  }
  scan.cloud.scanner_position = scan_from_room * Eigen::Vector3d(1, 1, 1.6);
  return scan;
}

class CheckPlanes : public ::testing::Test {
 protected:
  const RigidTransform slave_from_room_{rotation_exp({0.1, -0.2, 1.3}), {3, -2, 0.5}};
  const RigidTransform master_from_slave_ = slave_from_room_.inverse();
  const TestScan master_ = room(0, 0, {});
  const TestScan slave_ = room(1, 1, slave_from_room_);

  std::vector<CheckPlane> evaluate(const RigidTransform& master_from_slave) const {
    std::vector<CheckPlane> planes;
    for (const CommonPlane& pair : find_common_planes(master_.cloud, master_.regions, slave_.cloud,
                                                      slave_.regions, master_from_slave))
      planes.push_back(evaluate_check_plane(master_.cloud, slave_.cloud, pair, master_from_slave));
    return planes;
  }
};

TEST(CheckPlanesOfWalls, TheTwoSidesOfAWallAreTwoPlanes) {
  const auto side_of_wall = [](std::uint32_t scan_number, double x,
                               const Eigen::Vector3d& scanner) {
    RandomStream stream({22, 0, 0, scan_number, Purpose::test});
    TestScan scan;
    add_rectangle(scan, stream, {x, 0, 0}, {0, 3, 0}, {0, 0, 2}, 5000);
    scan.cloud.scanner_position = scanner;
    return scan;
  };
  const TestScan master = side_of_wall(0, 4, {1, 1, 1.6});
  const auto common = [&](const TestScan& slave) {
    return find_common_planes(master.cloud, master.regions, slave.cloud, slave.regions, {}).size();
  };
  EXPECT_EQ(common(side_of_wall(1, 4.1, {7, 1, 1.6})), 0u);
  EXPECT_EQ(common(side_of_wall(1, 4.1, {2, 1, 1.6})), 1u);    // 0.1 m off, but the same side
  EXPECT_EQ(common(side_of_wall(1, 4.002, {7, 1, 1.6})), 1u);  // a thin board
}

TEST_F(CheckPlanes, ThreeCommonPlanesAgreeToTheNoiseUnderTheTrueTransform) {
  const auto planes = evaluate(master_from_slave_);
  ASSERT_EQ(planes.size(), 3u);
  for (const CheckPlane& plane : planes) {
    EXPECT_NEAR(plane.alone_master_m, sigma_m, 0.05 * sigma_m);
    EXPECT_NEAR(plane.alone_slave_m, sigma_m, 0.05 * sigma_m);
    EXPECT_NEAR(plane.union_m, sigma_m, 0.05 * sigma_m);
    EXPECT_NEAR(plane.slave_to_master_m, sigma_m, 0.05 * sigma_m);
    // Offset at the centroid: at most 5 sd of the difference of two means, doubled for the lever
    // arm of the tilt.
    EXPECT_LT(std::abs(plane.offset_m),
              10 * sigma_m / std::sqrt(static_cast<double>(plane.points_slave)));
    EXPECT_LT(plane.tilt_rad, 5e-4);
  }
}

TEST_F(CheckPlanes, OnlyTheAreaThatBothScansCoverCounts) {
  const auto planes = evaluate(master_from_slave_);
  // The walls overlap from y = 1 to y = 3, two thirds of each.
  EXPECT_EQ(planes[0].points_master, 20000u);  // the floor
  EXPECT_NEAR(static_cast<double>(planes[1].points_master), 20000.0 * 2 / 3, 800);
}

// A shift of 2 mm along the wall's normal shows in the offset at once and hardly in the union's
// RMSE.
TEST_F(CheckPlanes, AShiftShowsInTheOffsetMoreThanInTheUnion) {
  const RigidTransform shift{Eigen::Matrix3d::Identity(), {0.002, 0, 0}};
  const auto planes = evaluate(shift * master_from_slave_);
  ASSERT_EQ(planes.size(), 3u);
  for (const CheckPlane& plane : planes) {
    const double expected_m = plane.normal.x() * 0.002;
    EXPECT_NEAR(plane.offset_m, expected_m, 2e-4);
    EXPECT_NEAR(plane.union_m, std::hypot(sigma_m, expected_m / 2), 0.06 * sigma_m);
  }
}

TEST_F(CheckPlanes, ATiltIsTheAngleBetweenThePlanes) {
  const RigidTransform turn{rotation_exp({0, 0, 0.003}), Eigen::Vector3d::Zero()};
  const auto planes = evaluate(turn * master_from_slave_);
  ASSERT_EQ(planes.size(), 3u);
  EXPECT_NEAR(planes[1].tilt_rad, 0.003, 5e-4);  // a wall
  EXPECT_LT(planes[0].tilt_rad, 5e-4);           // the floor turns in itself
}

TEST_F(CheckPlanes, ParallelPlanesThirtyCentimetresApartAreNotMistakenForEachOther) {
  const auto pairs =
      find_common_planes(master_.cloud, std::span(master_.regions).first(2), slave_.cloud,
                         std::span(slave_.regions).last(1), master_from_slave_);
  EXPECT_TRUE(pairs.empty());
}

TEST_F(CheckPlanes, OverlapIsTheShareOfPointsWithANeighbour) {
  EXPECT_GT(overlap_share(slave_.cloud, master_.cloud, master_from_slave_, 0.15), 0.8);
  const RigidTransform away{Eigen::Matrix3d::Identity(), {0, 0, 50}};
  EXPECT_EQ(overlap_share(slave_.cloud, master_.cloud, away * master_from_slave_, 0.15), 0);
}

}  // namespace
}  // namespace alea
