#include <gtest/gtest.h>

#include <cmath>

#include "alea/simulate/die_ray.hpp"
#include "alea/simulate/primitive_ray.hpp"

namespace alea {
namespace {

template <typename Object>
Hit shoot(const Object& object, const Eigen::Vector3d& origin, const Eigen::Vector3d& towards) {
  Hit hit;
  intersect(object, 3, {origin, towards.normalized()}, hit);
  return hit;
}

TEST(SphereRay, EntersWhereTheChordBegins) {
  const Sphere sphere{"ball", {5, 1, 2}, 0.5, 0.9};
  const Hit straight = shoot(sphere, {0, 1, 2}, {1, 0, 0});
  EXPECT_DOUBLE_EQ(straight.range_m, 4.5);
  EXPECT_LT((straight.normal - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-15);
  // 0.3 off the centre: half the chord is 0.4.
  const Hit off = shoot(sphere, {0, 1.3, 2}, {1, 0, 0});
  EXPECT_NEAR(off.range_m, 4.6, 1e-14);
  EXPECT_NEAR(off.normal.y(), 0.6, 1e-14);
  EXPECT_TRUE(std::isinf(shoot(sphere, {0, 1.50001, 2}, {1, 0, 0}).range_m));
  EXPECT_TRUE(std::isinf(shoot(sphere, {9, 1, 2}, {1, 0, 0}).range_m)) << "behind the ray";
}

TEST(SphereRay, KeepsItsDigitsAtLongRange) {
  const Sphere sphere{"ball", {1e5, 0, 0}, 0.0725, 0.9};
  EXPECT_NEAR(shoot(sphere, {0, 0.03, 0}, {1, 0, 0}).range_m,
              1e5 - std::sqrt(0.0725 * 0.0725 - 0.03 * 0.03), 1e-10);
}

TEST(CylinderRay, MeetsMantleAndEnds) {
  const Cylinder cylinder{"column", {0, 0, 1}, {0, 0, 2}, 0.5, {}, 0.3};
  const Hit mantle = shoot(cylinder, {3, 0.3, 2}, {-1, 0, 0});
  EXPECT_NEAR(mantle.range_m, 2.6, 1e-14);
  EXPECT_NEAR(mantle.normal.x(), 0.8, 1e-14);
  EXPECT_EQ(mantle.surface.facet, 0);
  const Hit top = shoot(cylinder, {0.2, 0.1, 5}, {0, 0, -1});
  EXPECT_DOUBLE_EQ(top.range_m, 2);
  EXPECT_EQ(top.surface.facet, 2);
  EXPECT_EQ(shoot(cylinder, {0.2, 0.1, 0}, {0, 0, 1}).surface.facet, 1);
  // Obliquely through the top: sinks one for each metre sideways.
  const Hit oblique = shoot(cylinder, {-1.3, 0, 4}, {1, 0, -1});
  EXPECT_NEAR(oblique.range_m, std::sqrt(2.0), 1e-14);
  EXPECT_EQ(oblique.surface.facet, 2);
  EXPECT_TRUE(std::isinf(shoot(cylinder, {3, 0, 3.01}, {-1, 0, 0}).range_m)) << "over the top";
  EXPECT_TRUE(std::isinf(shoot(cylinder, {3, 0.51, 2}, {-1, 0, 0}).range_m));
}

TEST(BoxRay, NamesTheFaceAndItsNormal) {
  const Box box{"box", {2, 4, 6}, {rotation_exp({0, 0, M_PI / 6}), {1, 2, 3}}, 0.5};
  const Eigen::Vector3d x = box.scene_from_box.rotation.col(0);
  const Hit hit = shoot(box, Eigen::Vector3d(1, 2, 3) + 5 * x, -x);
  EXPECT_NEAR(hit.range_m, 4, 1e-14);
  EXPECT_LT((hit.normal - x).norm(), 1e-15);
  EXPECT_EQ(hit.surface.facet, 2) << "+x";
  EXPECT_EQ(shoot(box, {1, 2, -9}, {0, 0, 1}).surface.facet, 5) << "-z";
  EXPECT_TRUE(std::isinf(shoot(box, {1, 2, -9}, {0, 0, -1}).range_m));
}

TEST(PatchRay, EndsAtItsSides) {
  const Patch patch{"wall", {2, -1, 0}, {0, 2, 0}, {0, 0, 3}, 0.4};
  EXPECT_DOUBLE_EQ(shoot(patch, {0, 0.999, 2.999}, {1, 0, 0}).range_m, 2);
  EXPECT_TRUE(std::isinf(shoot(patch, {0, 1.001, 1}, {1, 0, 0}).range_m));
  EXPECT_DOUBLE_EQ(shoot(patch, {5, 0, 1}, {-1, 0, 0}).range_m, 3) << "from behind too";
}

TEST(CheckerboardRay, ShowsCellsMarginAndNothingBeyond) {
  Checkerboard board;
  board.columns = 3;
  board.rows = 2;
  board.cell_m = 0.1;
  board.margin_m = 0.05;
  board.scene_from_board = {rotation_exp({0, M_PI / 2, 0}), {4, 0, 1}};
  const Eigen::Matrix3d& turn = board.scene_from_board.rotation;
  const auto at = [&](double x, double y) {
    const Eigen::Vector3d place = board.scene_from_board * Eigen::Vector3d(x, y, 0);
    return shoot(board, place + 2 * turn.col(2), -turn.col(2));
  };
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 2; ++row) {
      const Hit hit = at(-0.1 + 0.1 * column, -0.05 + 0.1 * row);
      EXPECT_NEAR(hit.range_m, 2, 1e-14);
      EXPECT_EQ(hit.intensity, (column + row) % 2 == 0 ? 0.1 : 0.9) << column << row;
    }
  EXPECT_EQ(at(0.17, 0).intensity, 0.5) << "margin";
  EXPECT_TRUE(std::isinf(at(0.201, 0).range_m));
  EXPECT_TRUE(std::isinf(at(0, 0.151).range_m));
}

DieModel unit_die() {
  DieModel model;
  model.size_m.setOnes();
  return model;
}

TEST(DieRay, RoundedEdgesAreCylindersAndCornersSpheres) {
  DieModel model = unit_die();
  model.edge_radius_m = 0.1;
  const Die die = build_die(model);
  // The edge along z at x = y = 0.5: its axis is at (0.4, 0.4).
  const Hit edge = shoot(die, {3, 3, 0.1}, {-1, -1, 0});
  EXPECT_NEAR(edge.range_m, std::sqrt(2.0) * 2.6 - 0.1, 1e-13);
  EXPECT_EQ(edge.surface.facet, 0);
  EXPECT_NEAR(edge.normal.x(), std::sqrt(0.5), 1e-13);
  const Hit corner = shoot(die, {3, 3, 3}, {-1, -1, -1});
  EXPECT_NEAR(corner.range_m, std::sqrt(3.0) * 2.6 - 0.1, 1e-13);
  // The facets themselves stay where they were.
  const Hit flat = shoot(die, {3, 0.39, 0.39}, {-1, 0, 0});
  EXPECT_NEAR(flat.range_m, 2.5, 1e-14);
  EXPECT_NE(flat.surface.facet, 0);
  const Hit rounded = shoot(die, {3, 0.46, 0}, {-1, 0, 0});
  EXPECT_NEAR(rounded.range_m, 2.6 - std::sqrt(0.01 - 0.0036), 1e-13);
  EXPECT_TRUE(std::isinf(shoot(die, {3, 0.499, 0.499}, {-1, 0, 0}).range_m))
      << "the corner is gone";
}

TEST(DieRay, ABowIsAParaboloidOfTwoThirdsOnAverage) {
  DieModel model = unit_die();
  const double bow = 0.01;
  for (FacetShape& facet : model.facets) facet.bow_m = bow;
  const Die die = build_die(model);
  double sum = 0;
  const int n = 40;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double y = (i + 0.5) / n - 0.5, z = (k + 0.5) / n - 0.5;
      const double height = 2.5 - shoot(die, {3, y, z}, {-1, 0, 0}).range_m;
      EXPECT_NEAR(height, bow * (1 - (4 * y * y + 4 * z * z) / 2), 1e-12);
      sum += height / (n * n);
    }
  EXPECT_NEAR(sum, bow * 2 / 3, 1e-4 * bow + bow / (n * n));
  // Obliquely the crossing of ray and paraboloid, not of the plane.
  const Hit oblique = shoot(die, {3, 2.6, 0}, {-1, -1, 0});
  const Eigen::Vector3d p =
      Eigen::Vector3d(3, 2.6, 0) + oblique.range_m * Eigen::Vector3d(-1, -1, 0).normalized();
  EXPECT_NEAR(p.x() - 0.5, bow * (1 - 4 * p.y() * p.y() / 2), 1e-12);
}

TEST(DieRay, APipIsItsIntensityAndItsRecess) {
  DieModel model = unit_die();
  model.pips.recess_m = 0.004;
  const Die die = build_die(model);
  const DieFacet& one = die.facets[0];
  const Eigen::Vector3d n = one.plane.normal;
  const Hit floor = shoot(die, one.centre_m + 2 * n, -n);
  EXPECT_NEAR(floor.range_m, 2.004, 1e-14);
  EXPECT_EQ(floor.intensity, model.pips.intensity);
  const Hit beside = shoot(die, one.centre_m + 2 * n + 0.1 * one.u, -n);
  EXPECT_NEAR(beside.range_m, 2, 1e-14);
  EXPECT_EQ(beside.intensity, model.intensity);
  // At 45 deg just inside the far rim the wall is met before the floor.
  const Eigen::Vector3d inside = one.centre_m + (one.pip_radius_m - 0.001) * one.u;
  const Hit wall = shoot(die, inside + n - one.u, -n + one.u);
  EXPECT_NEAR(wall.range_m, std::sqrt(2.0) * 1.001, 1e-12);
}

}  // namespace
}  // namespace alea
