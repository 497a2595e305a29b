#include "alea/die/die_finder.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/plane/exact_predicates.hpp"
#include "tests/support/die_scan.hpp"

namespace alea {
namespace {

using test::DieScan;
using test::scan_die;

DieFinderOptions for_edge(double edge_m) {
  DieFinderOptions options;
  options.edge_m = edge_m;
  options.facets.fit.scanner_position = Eigen::Vector3d::Zero();
  return options;
}

Box box_at(const Eigen::Vector3d& size, double x, double y, double turn_rad) {
  Box box;
  box.size_m = size;
  box.scene_from_box = levelled_pose({x, y, size.z() / 2}, turn_rad);
  return box;
}

Scene furniture() {
  Scene scene;
  scene.boxes.push_back(box_at({0.3, 0.4, 0.9}, -0.9, 0.6, 0.3));
  scene.boxes.push_back(box_at({0.8, 0.4, 0.7}, 0.4, -1.1, 0.9));
  scene.boxes.push_back(box_at({0.25, 0.25, 0.25}, 0.9, 0.2, 0.2));
  return scene;
}

auto find(const DieScan& scan, const DieFinderOptions& options) {
  return find_dice(scan.cloud, detect_planes(scan.cloud), options);
}

TEST(DieFinder, FindsTheDieAmongOtherBoxes) {
  const DieScan scan = scan_die({}, 4, 2.5e-3, furniture());
  const auto dice = find(scan, for_edge(0.5));
  ASSERT_TRUE(dice) << dice.refusal().message;
  ASSERT_EQ(dice->size(), 1u);
  EXPECT_LT((dice->front().centre_m - scan.centre_m).norm(), 0.02);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(dice->front().dihedral_rad[k], std::numbers::pi / 2, 0.005);
    EXPECT_LT(std::abs(dice->front().size_error[k]), 0.05);
    EXPECT_GT(dice->front().coverage[k], 0.9);
  }
}

TEST(DieFinder, TwoLikeDiceAreTwoCandidatesAndNearPicksOne) {
  Scene scene;
  DieModel second;
  second.scene_from_die = levelled_pose({-0.7, 0.9, 0.25}, 1.185);
  scene.dice.push_back(build_die(second));
  const DieScan scan = scan_die({}, 4, 2.5e-3, scene);
  const auto both = find(scan, for_edge(0.5));
  ASSERT_TRUE(both);
  EXPECT_EQ(both->size(), 2u);
  DieFinderOptions near = for_edge(0.5);
  near.near_m = scan.centre_m;
  near.near_radius_m = 0.5;
  const auto one = find(scan, near);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->size(), 1u);
  EXPECT_LT((one->front().centre_m - scan.centre_m).norm(), 0.02);
}

TEST(DieFinder, RefusesWhatIsNoDie) {
  const DieScan scan = scan_die({}, 4, 2.5e-3);
  const auto wrong_size = find(scan, for_edge(0.4));
  ASSERT_FALSE(wrong_size);
  EXPECT_EQ(wrong_size.refusal().code, RefusalCode::size_mismatch);

  DieModel skewed;
  skewed.facets[1].tilt_u_rad = 25 * std::numbers::pi / 180;
  const auto leaning = find(scan_die(skewed, 4, 2.5e-3), for_edge(0.5));
  DieModel skewed_v;
  skewed_v.facets[1].tilt_v_rad = 25 * std::numbers::pi / 180;
  const auto leaning_v = find(scan_die(skewed_v, 4, 2.5e-3), for_edge(0.5));
  ASSERT_FALSE(leaning);
  ASSERT_FALSE(leaning_v);
  EXPECT_TRUE(leaning.refusal().code == RefusalCode::dihedral ||
              leaning_v.refusal().code == RefusalCode::dihedral);

  DieScan empty = scan;
  std::vector<std::uint32_t> floor;
  for (std::uint32_t i = 0; i < scan.cloud.size(); ++i)
    if (scan.cloud.positions[i].z() < -1.59) floor.push_back(i);
  empty.cloud = subset(scan.cloud, floor);
  const auto nothing = find(empty, for_edge(0.5));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.refusal().code, RefusalCode::no_die);

  DieScan two = scan;  // without its top
  std::vector<std::uint32_t> sides;
  for (std::uint32_t i = 0; i < scan.cloud.size(); ++i)
    if (std::abs(scan.planes[0].signed_distance(scan.cloud.positions[i])) > 0.02)
      sides.push_back(i);
  two.cloud = subset(scan.cloud, sides);
  const auto missing = find(two, for_edge(0.5));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.refusal().code, RefusalCode::too_few_facets);
  EXPECT_THROW(find(scan, for_edge(-1)), Error);
}

TEST(DieFinder, ACuboidIsHeldAgainstItsOwnEdges) {
  DieModel cuboid;
  cuboid.size_m = {0.5, 0.4, 0.3};  // 1-6 stands upright
  const DieScan scan = scan_die(cuboid, 4, 2.5e-3);
  DieFinderOptions options = for_edge(0.5);
  EXPECT_FALSE(find(scan, options));
  options.edges_m = {0.3, 0.5, 0.4};
  const auto dice = find(scan, options);
  ASSERT_TRUE(dice) << dice.refusal().message;
  for (const double error : dice->front().size_error) EXPECT_LT(std::abs(error), 0.06);
}

TEST(CornerDecision, AnInnerCornerOrOneSeenFromBehindIsNotADie) {
  std::array<Plane, 3> planes;
  std::array<Eigen::Vector3d, 3> centres;
  for (int k = 0; k < 3; ++k) {
    planes[k] = {Eigen::Vector3d::Unit(k), 0};
    centres[k] = Eigen::Vector3d::Constant(-0.25) + 0.25 * Eigen::Vector3d::Unit(k);
  }
  const Eigen::Vector3d front(4, 4, 4), below(4, 4, -1);
  EXPECT_TRUE(decide_corner(planes, centres, front).accepted());
  EXPECT_FALSE(decide_corner(planes, centres, below).faces_scanner);
  EXPECT_FALSE(decide_corner(planes, centres, Eigen::Vector3d(4, 4, 0)).faces_scanner)
      << "in the plane is not outside";
  auto inner = centres;
  for (Eigen::Vector3d& centre : inner) centre = -centre;
  EXPECT_FALSE(decide_corner(planes, inner, front).convex);
  auto flat = planes;
  flat[2].normal = planes[0].normal;
  EXPECT_FALSE(decide_corner(flat, centres, front).single_point);
}

}  // namespace
}  // namespace alea
