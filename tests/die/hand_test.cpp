#include "alea/die/hand.hpp"

#include <gtest/gtest.h>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/plane/exact_predicates.hpp"

namespace alea {
namespace {

ObservedDie seen(const DieShape& shape, const std::array<int, 3>& pips) {
  return observe_exactly(shape, pips, {rotation_exp({0.3, -0.8, 1.9}), {4, 5, 6}});
}

TEST(Hand, OneTwoThreeRunClockwiseSeenFromOutside) {
  // Looking from outside at the corner of 1, 2, 3: the cross product of consecutive facets' centres
  // in the direction of view says which way they run.
  for (const Chirality hand : {Chirality::clockwise, Chirality::counterclockwise}) {
    const DieShape shape = cube(1, hand);
    const Eigen::Vector3d one = shape.facet(1)->normal, two = shape.facet(2)->normal,
                          three = shape.facet(3)->normal, view = one + two + three;
    const double turn = (two - one).cross(three - two).dot(view);  // > 0: counterclockwise
    EXPECT_EQ(turn < 0, hand == Chirality::clockwise);
    EXPECT_EQ(hand_of(shape), hand);
  }
}

TEST(Hand, IsTheSameAtEveryCorner) {
  for (const Chirality hand : {Chirality::clockwise, Chirality::counterclockwise})
    for (const int a : {1, 6})
      for (const int b : {2, 5})
        for (const int c : {3, 4}) EXPECT_EQ(hand_of(seen(cube(0.5, hand), {a, b, c})), hand);
}

TEST(CheckPair, RefusesEachKindOfWrongDieByItsCode) {
  const DieShape right = cube(0.5, Chirality::clockwise);
  const DieShape left = cube(0.5, Chirality::counterclockwise);
  const ObservedDie r123 = seen(right, {1, 2, 3}), r124 = seen(right, {1, 2, 4}),
                    l123 = seen(left, {1, 2, 3}), l124 = seen(left, {1, 2, 4});
  EXPECT_FALSE(check_pair(r123, r124, HandRule::clockwise));
  EXPECT_FALSE(check_pair(l123, l124, HandRule::counterclockwise));
  EXPECT_FALSE(check_pair(l123, l124, HandRule::any));
  EXPECT_EQ(check_pair(l123, l124, HandRule::clockwise)->code, RefusalCode::chirality);
  EXPECT_EQ(check_pair(r123, l124, HandRule::any)->code, RefusalCode::mirrored);

  DieShape skew = right;
  skew.facets[1]->normal = rotation_exp({21 * deg, 0, 0}) * skew.facets[1]->normal;
  EXPECT_EQ(check_pair(seen(skew, {1, 2, 3}), r124, HandRule::any)->code, RefusalCode::dihedral);
  skew.facets[1]->normal = rotation_exp({-2 * deg, 0, 0}) * skew.facets[1]->normal;
  EXPECT_FALSE(check_pair(seen(skew, {1, 2, 3}), r124, HandRule::any));
}

TEST(Hand, LabelsThatCannotMeetAreMisuse) {
  ObservedDie die = seen(cube(0.5, Chirality::clockwise), {1, 2, 3});
  die.facets[2].pips = 6;
  EXPECT_FALSE(labels_meet_at_a_corner(1, 2, 6));
  EXPECT_FALSE(labels_meet_at_a_corner(1, 2, 7));
  EXPECT_THROW(hand_of(die), Error);
}

// Doubles decide these wrongly: the determinant of three nearly coplanar vectors drowns in
// rounding.
TEST(ExactPredicates, DecideWhatDoublesCannot) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const Eigen::Vector3d a(1, 0.1, 0.3), b(3, 0.1 * 3, 0.3 * 3);
  // 0.1 * 3 and 0.3 * 3 are rounded, so b is not a multiple of a, though within an ulp of one.
  EXPECT_FALSE(exactly_parallel({a, 0}, {b, 0}));
  EXPECT_TRUE(exactly_parallel({a, 0}, {2 * a, 1}));
  EXPECT_TRUE(exactly_parallel({a, 0}, {-a, 1}));
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  EXPECT_EQ(exact_orientation(x, y, {1, 1, tiny}), 1);
  EXPECT_EQ(exact_orientation(y, x, {1, 1, tiny}), -1);
  EXPECT_EQ(exact_orientation(x, y, x + y), 0);
  EXPECT_EQ(exact_sign_of_dot({1e200, 1, 0}, {1, -1e200, tiny}), 0);
  EXPECT_EQ(exact_sign_of_dot({1, 1, 0}, {1, -1 - 1e-15, 0}), -1);
}

TEST(DihedralAngles, AreTheAnglesInsideTheDie) {
  DieShape shape = cube(0.5, Chirality::clockwise);
  for (const DihedralAngle& angle : dihedral_angles(seen(shape, {1, 2, 3})))
    EXPECT_NEAR(angle.angle_rad, 90 * deg, 1e-12);
  // 1 looks up, 3 along x: leaning 3 upwards by 1 deg makes the edge 1-3 blunt.
  shape.facets[2]->normal = rotation_exp({0, -1 * deg, 0}) * shape.facets[2]->normal;
  const auto angles = dihedral_angles(seen(shape, {1, 2, 3}));
  EXPECT_EQ(angles[1].first_pips, 1);
  EXPECT_EQ(angles[1].second_pips, 3);
  EXPECT_NEAR(angles[1].angle_rad, 91 * deg, 1e-12);
}

}  // namespace
}  // namespace alea
