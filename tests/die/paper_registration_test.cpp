#include "alea/die/paper_registration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <set>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/die/ideal_observation.hpp"

namespace alea {
namespace {

RigidTransform pose(int number) {
  return {rotation_exp({0.1 * number, -0.4, 0.9 + number}), {3.0 + number, -5, 1.5}};
}

/// A cuboid of 0.4 x 0.5 x 0.6 m between 1 and 6, 2 and 5, 3 and 4.
DieShape cuboid(Chirality hand) {
  DieShape shape = cube(1, hand);
  const std::array<double, 3> size_m{0.4, 0.5, 0.6};
  for (int pips = 1; pips <= 6; ++pips)
    shape.facets[pips - 1]->offset_m = size_m[die_axis(pips)] / 2;
  return shape;
}

const DieDimensions cuboid_size{0.4, 0.5, 0.6};

std::vector<std::array<int, 3>> all_corners() {
  std::vector<std::array<int, 3>> corners;
  for (const int a : {1, 6})
    for (const int b : {2, 5})
      for (const int c : {3, 4}) corners.push_back({a, b, c});
  return corners;
}

TEST(CornerFrame, ThereAreTwentyFourAndEachIsBuiltWhereItsCornerIsSeen) {
  for (const Chirality hand : {Chirality::clockwise, Chirality::counterclockwise}) {
    std::set<std::string> built, listed;
    for (const FrameLabel& label : all_frame_labels(hand))
      listed.insert(std::to_string(label.up) + " " + axis_names(label));
    for (const auto& corner : all_corners())
      for (const int up : corner) {
        const auto frame = corner_frame(observe_exactly(cuboid(hand), corner, pose(1)), up);
        ASSERT_TRUE(frame);
        built.insert(std::to_string(frame->label.up) + " " + axis_names(frame->label));
        EXPECT_NEAR(frame->axes.determinant(), 1, 1e-12);
        EXPECT_NEAR((frame->axes - frame->normals).norm(), 0, 1e-12);
      }
    EXPECT_EQ(listed.size(), 24u);
    EXPECT_EQ(built, listed);
  }
}

TEST(CornerFrame, AxesLieInTheFacetsThatNameThem) {
  DieShape skew = cuboid(Chirality::clockwise);
  for (int f = 0; f < 6; ++f)
    skew.facets[f]->normal = rotation_exp({0.02 * f, 0.03, -0.01 * f}) * skew.facets[f]->normal;
  const ObservedDie die = observe_exactly(skew, {1, 2, 4}, pose(2));
  const auto frame = corner_frame(die, 2);
  ASSERT_TRUE(frame);
  const auto normal = [&](int pips) { return find_facet(die, pips)->fit.plane.normal; };
  const FrameLabel& label = frame->label;
  EXPECT_NEAR(frame->axes.col(0).dot(normal(label.up)), 0, 1e-15);
  EXPECT_NEAR(frame->axes.col(0).dot(normal(label.x_side)), 0, 1e-15);
  EXPECT_NEAR(frame->axes.col(1).dot(normal(label.y_side)), 0, 1e-15);
  EXPECT_LT(frame->axes.col(0).dot(normal(label.y_side)), -0.9);  // into the die
  EXPECT_GT(frame->axes.col(2).dot(normal(label.up)), 0.9);       // up
  EXPECT_THROW(corner_frame(die, 6), Error);
}

TEST(OrthogonalAxes, EveryRuleGivesARotationThatKeepsItsAxis) {
  DieShape skew = cuboid(Chirality::clockwise);
  for (int f = 0; f < 6; ++f)
    skew.facets[f]->normal = rotation_exp({0.02 * f, 0.03, -0.01 * f}) * skew.facets[f]->normal;
  const auto frame = corner_frame(observe_exactly(skew, {1, 2, 3}, pose(3)), 1);
  ASSERT_TRUE(frame);
  for (const FrameRule rule : {FrameRule::fix_x, FrameRule::fix_y, FrameRule::fix_z,
                               FrameRule::polar, FrameRule::top_normal, FrameRule::mean_heading}) {
    const Eigen::Matrix3d v = orthogonal_axes(*frame, rule);
    EXPECT_NEAR((v.transpose() * v - Eigen::Matrix3d::Identity()).norm(), 0, 1e-14);
    EXPECT_NEAR(v.determinant(), 1, 1e-14);
    EXPECT_LT((v - frame->axes).norm(), 0.3);
  }
  for (int k = 0; k < 3; ++k) {
    const FrameRule rule = k == 0 ? FrameRule::fix_x : k == 1 ? FrameRule::fix_y : FrameRule::fix_z;
    EXPECT_NEAR((orthogonal_axes(*frame, rule).col(k) - frame->axes.col(k)).norm(), 0, 1e-15);
  }
  EXPECT_NEAR(orthogonal_axes_as_printed(*frame).determinant(), -1, 1e-14);
}

// Every pair of corners, every common or opposite upper facet: lengths and turns come from labels.
TEST(PaperRegistration, IsExactOnACuboidForEveryPairOfCorners) {
  for (const Chirality hand : {Chirality::clockwise, Chirality::counterclockwise}) {
    const RigidTransform truth = pose(1) * pose(4).inverse();
    for (const auto& a : all_corners())
      for (const auto& b : all_corners()) {
        PaperRegistrationOptions options;
        options.dimensions = cuboid_size;
        options.hand = HandRule::any;
        const auto found = register_paper(observe_exactly(cuboid(hand), a, pose(1)),
                                          observe_exactly(cuboid(hand), b, pose(4)), options);
        ASSERT_TRUE(found);
        EXPECT_LT((found->master_from_slave.matrix() - truth.matrix()).norm(), 1e-11);
      }
  }
}

TEST(VFromU, AQuarterTurnHasOneLengthAndAHalfTurnTwo) {
  const auto labels = all_frame_labels(Chirality::clockwise);
  const FrameLabel v = labels[0];
  std::array<int, 3> seen{};
  for (const FrameLabel& u : labels) {
    if (u.up != v.up) continue;
    const RigidTransform turn = v_from_u(v, u, cuboid_size);
    EXPECT_EQ(turn.rotation.col(2), Eigen::Vector3d::UnitZ());
    EXPECT_EQ(turn.translation.z(), 0);
    const auto quarters = std::lround(rotation_angle_rad(turn.rotation) / (90 * deg));
    EXPECT_EQ((turn.translation.array().abs() > 1e-12).count(), quarters);
    ++seen[quarters];
  }
  EXPECT_EQ(seen, (std::array<int, 3>{1, 2, 1}));
}

TEST(PaperRegistration, DimensionsMoveTheTranslationAsTheDerivativeSays) {
  PaperRegistrationOptions options;
  options.dimensions = cuboid_size;
  const DieShape shape = cuboid(Chirality::clockwise);
  const ObservedDie master = observe_exactly(shape, {1, 2, 3}, pose(1)),
                    slave = observe_exactly(shape, {1, 2, 4}, pose(4));
  const auto before = register_paper(master, slave, options);
  options.dimensions.from_3_to_4_m += 0.02;
  options.dimensions.lift_m += 0.03;
  const auto after = register_paper(master, slave, options);
  ASSERT_TRUE(before && after);
  const Eigen::Vector3d expected =
      before->translation_by_dimensions * Eigen::Vector4d(0, 0, .02, .03);
  EXPECT_NEAR(
      (after->master_from_slave.translation - before->master_from_slave.translation - expected)
          .norm(),
      0, 1e-12);
  EXPECT_NEAR(before->translation_by_dimensions.col(0).norm(), 0, 1e-12);  // both see 1 on top
  EXPECT_NEAR(before->translation_by_dimensions.col(2).norm(), 1, 1e-12);
}

/// Error of a misprint on a perfect 0.5 m cube: angle (deg), displacement of the die's centre (mm).
std::pair<double, double> damage(const std::array<int, 3>& slave_corner,
                                 const PrintedErrors& errors) {
  const DieShape shape = cube(0.5, Chirality::clockwise);
  const RigidTransform master_from_die = pose(1), slave_from_die = pose(4);
  PaperRegistrationOptions options;
  options.dimensions = {0.5, 0.5, 0.5};
  options.errors = errors;
  options.up_pips = 1;
  const auto found = register_paper(observe_exactly(shape, {1, 2, 3}, master_from_die),
                                    observe_exactly(shape, slave_corner, slave_from_die), options);
  const RigidTransform& t = found->master_from_slave;
  const RigidTransform truth = master_from_die * slave_from_die.inverse();
  return {rotation_angle_rad(t.rotation * truth.rotation.transpose()) / deg,
          1e3 * (t * slave_from_die.translation - master_from_die.translation).norm()};
}

TEST(PrintedErrors, EachDoesTheDamageOfTheStudy) {
  const std::array<int, 3> quarter{1, 3, 5}, opposite{1, 4, 5};
  const auto expect = [](const std::pair<double, double>& found, double angle_deg, double mm) {
    EXPECT_NEAR(found.first, angle_deg, 0.5);
    EXPECT_NEAR(found.second, mm, 0.6);
  };
  PrintedErrors errors;
  expect(damage(quarter, errors), 0, 0);
  expect(damage(opposite, errors), 0, 0);
  errors.left_handed_axes = true;
  expect(damage(quarter, errors), 96, 1269);
  expect(damage(opposite, errors), 141, 1795);
  errors.direct_pairing = true;
  expect(damage(quarter, errors), 180, 707);
  expect(damage(opposite, errors), 0, 1000);
  errors = {};
  errors.reversed_turn = true;
  expect(damage(quarter, errors), 180, 707);
  expect(damage(opposite, errors), 0, 0);
  errors = {};
  errors.opposite_offset = true;
  expect(damage(quarter, errors), 0, 500);
  expect(damage(opposite, errors), 0, 0);
  errors = {};
  errors.no_corner = true;
  EXPECT_GT(damage(quarter, errors).second, 1000);
}

TEST(PaperRegistration, RefusesAnUpperFacetThatOneScanDoesNotSee) {
  const DieShape shape = cube(0.5, Chirality::clockwise);
  PaperRegistrationOptions options;
  options.dimensions = {0.5, 0.5, 0.5};
  options.up_pips = 3;
  const auto found = register_paper(observe_exactly(shape, {1, 2, 3}, pose(1)),
                                    observe_exactly(shape, {1, 2, 4}, pose(4)), options);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.refusal().code, RefusalCode::unobservable);
}

}  // namespace
}  // namespace alea
