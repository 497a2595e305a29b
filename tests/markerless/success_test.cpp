#include "experiments/markerless/success.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace alea::experiments::markerless {
namespace {

/// Poses of `pairs` pairs, one true and one false each, whose conflict ratios are given.
std::vector<JudgedPose> poses_of(int pairs, double (*right)(int), double (*wrong)(int)) {
  std::vector<JudgedPose> poses;
  for (int i = 0; i < pairs; ++i)
    for (const bool is_right : {true, false}) {
      JudgedPose pose;
      pose.pair = std::to_string(i);
      pose.error = {is_right ? 0.1 : 60.0, is_right ? 0.01 : 5.0};
      pose.conflict_ratio = is_right ? right(i) : wrong(i);
      pose.margin = -pose.conflict_ratio;
      poses.push_back(pose);
    }
  return poses;
}

const PoseFigure conflict{"conflict", 1, &JudgedPose::conflict_ratio};
const PoseFigure margin{"margin", -1, &JudgedPose::margin};

TEST(AreaUnderRoc, IsOneWhereTheFigureSeparates) {
  const auto poses = poses_of(
      20, [](int i) { return 0.001 * i; }, [](int i) { return 1.0 + i; });
  EXPECT_EQ(area_under_roc(poses, conflict, 1).median, 1);
  EXPECT_EQ(area_under_roc(poses, margin, 1).median, 1);
}

TEST(AreaUnderRoc, IsAHalfWhereItSaysNothing) {
  const auto poses = poses_of(
      20, [](int i) { return i % 5 * 1.0; }, [](int i) { return 2 * i % 5 * 1.0; });
  const Interval area = area_under_roc(poses, conflict, 1);
  EXPECT_DOUBLE_EQ(area.median, 0.5);
  EXPECT_LT(area.low, 0.5);
  EXPECT_GT(area.high, 0.5);
  EXPECT_LT(area.high - area.low, 0.5);
}

TEST(AreaUnderRoc, ItsIntervalIsWiderForFewerPairs) {
  const auto right = [](int i) { return i * 7 % 11 * 1.0; };
  const auto wrong = [](int i) { return 3.0 + i * 5 % 11; };
  const Interval few = area_under_roc(poses_of(11, right, wrong), conflict, 1);
  const Interval many = area_under_roc(poses_of(110, right, wrong), conflict, 1);
  EXPECT_NEAR(few.median, many.median, 0.03);
  EXPECT_GT(few.high - few.low, 2 * (many.high - many.low));
}

TEST(Closure, IsWhatTheLoopMovesAtFiveMetres) {
  RigidTransform pose;
  pose.rotation = rotation_exp({0.1, -0.2, 0.7});
  pose.translation = {3, -1, 0.5};
  EXPECT_NEAR(closure_m(pose, pose.inverse()), 0, 1e-12);
  RigidTransform turn;
  turn.rotation = rotation_exp({0, 0, std::numbers::pi / 180});
  EXPECT_NEAR(closure_m(pose, pose.inverse() * turn), 5 * std::numbers::pi / 180, 1e-9);
}

TEST(Pairs, AreBothWays) {
  EXPECT_EQ(all_pairs(4).size(), 12u);
  const auto pairs = reference_pairs(4, 2);
  ASSERT_EQ(pairs.size(), 6u);
  EXPECT_EQ(pairs[0].fixed, 2u);
  EXPECT_EQ(pairs[3].moving, 2u);
}

}  // namespace
}  // namespace alea::experiments::markerless
