#include <gtest/gtest.h>

#include "alea/checkerboard/board_finder.hpp"
#include "alea/simulate/board_sensor.hpp"
#include "tests/checkerboard/printed_board.hpp"

namespace alea {
namespace {

const RigidTransform board_pose = [] {
  RigidTransform pose;
  pose.rotation << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  pose.rotation = pose.rotation * rotation_exp({0.2, -0.1, 0}) * rotation_exp({0, 0, 0.4});
  pose.translation = {10, 0.2, -0.1};
  return pose;
}();

Cloud scan(const Checkerboard& board) {
  return scan_board(board, board_pose, survey_sensor(), {41, 0, 1, 0, Purpose::test});
}

/// Without the points whose x on the board is above `most_m`.
Cloud hidden_beyond(double most_m, const Cloud& cloud) {
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if ((board_pose.inverse() * cloud.positions[i]).x() <= most_m) seen.push_back(i);
  Cloud rest = subset(cloud, seen);
  rest.scanner_position = cloud.scanner_position;
  return rest;
}

TEST(BoardInTheWorld, TwoByTwoCellsArePartlyHidden) {
  const BoardSpec board{2, 2, 0.15};
  const Cloud cloud = hidden_beyond(0.06, scan(printed(board)));
  const auto result = measure_by_likelihood(cloud, board_pose.translation, options_for(board));
  ASSERT_TRUE(result) << result.refusal().message;
  EXPECT_LT((result->centre_m - board_pose.translation).norm(), 5e-4);
  // The whole board of that width is another one.
  const auto smaller =
      measure_by_likelihood(scan(printed({2, 2, 0.1})), board_pose.translation, options_for(board));
  ASSERT_FALSE(smaller);
  EXPECT_EQ(smaller.refusal().code, RefusalCode::size_mismatch);
}

// Of many cells any column may be the last one that is seen.
TEST(BoardInTheWorld, ManyCellsPartlyHiddenAreRefused) {
  const BoardSpec board{8, 6, 0.06};
  const Cloud cloud = hidden_beyond(0.12, scan(printed(board)));
  EXPECT_FALSE(measure_by_likelihood(cloud, board_pose.translation, options_for(board)));
}

TEST(BoardInTheWorld, IsFoundWhereTheCentreIsJustAsFarAsItMayBe) {
  const BoardSpec board{8, 6, 0.06};
  const Cloud cloud = scan(printed(board));
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector3d near = board_pose * Eigen::Vector3d(sign * board.side_m(), 0, 0);
    const auto result = measure_by_likelihood(cloud, near, options_for(board));
    ASSERT_TRUE(result) << result.refusal().message;
    EXPECT_LT((result->centre_m - board_pose.translation).norm(), 3e-4);
  }
}

TEST(BoardInTheWorld, ColoursCountWhereAllIntensitiesAreEqual) {
  Cloud cloud = scan(printed({2, 2, 0.15}));
  for (const float value : cloud.intensity) {
    const auto level = static_cast<std::uint16_t>(60000 * std::clamp(value, 0.0f, 1.0f));
    cloud.colours.push_back({level, level, level});
  }
  cloud.intensity.assign(cloud.size(), 0);
  const auto result = measure_by_likelihood(with_intensity(cloud), board_pose.translation,
                                            options_for({2, 2, 0.15}));
  ASSERT_TRUE(result) << result.refusal().message;
  EXPECT_LT((result->centre_m - board_pose.translation).norm(), 5e-4);
}

/// A light wall of 0.9 m with one dark square of 0.15 m amid it, seen by a beam so wide that a
/// whole board would correlate by 0.8 only.
Cloud wall_with_dark_cell(std::uint64_t trial) {
  RandomStream random({43, 0, trial, 0, Purpose::test});
  Cloud cloud;
  for (int k = 0; k < 2500; ++k) {
    const Eigen::Vector2d at(0.9 * random.uniform() - 0.45, 0.9 * random.uniform() - 0.45);
    const bool dark = at.cwiseAbs().maxCoeff() <= 0.075;
    const Eigen::Vector3d noise(0.015 * random.normal(), 0.015 * random.normal(),
                                5e-4 * random.normal());
    cloud.positions.push_back(board_pose * (Eigen::Vector3d(at.x(), at.y(), 0) + noise));
    cloud.intensity.push_back(static_cast<float>((dark ? 0.1 : 0.8) + 0.03 * random.normal()));
  }
  return cloud;
}

// Three of the four cells are right where the corner of a dark cell is taken for the centre.
TEST(BoardInTheWorld, OneDarkCellInALightWallIsNoBoard) {
  const BoardSpec board{2, 2, 0.15};
  for (std::uint64_t trial = 0; trial < 12; ++trial) {
    const auto result = measure_by_likelihood(wall_with_dark_cell(trial), board_pose.translation,
                                              options_for(board));
    ASSERT_FALSE(result) << trial;
    EXPECT_EQ(result.refusal().code, RefusalCode::no_pattern) << result.refusal().message;
  }
}

TEST(BoardInTheWorld, ManyCellsAreFoundWithoutAPlaceAndNothingElse) {
  const BoardSpec board{8, 6, 0.06};
  Cloud cloud = scan(printed(board));
  RandomStream noise({42, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 150; ++i)  // a wall whose intensities are noise alone
    for (int j = 0; j < 150; ++j) {
      cloud.positions.emplace_back(10.5, 0.01 * i - 2.5, 0.01 * j - 0.7);
      cloud.intensity.push_back(static_cast<float>(noise.uniform()));
    }
  const auto found = find_boards(cloud, options_for(board));
  ASSERT_TRUE(found) << found.refusal().message;
  ASSERT_EQ(found->size(), 1u);
  EXPECT_LT((found->front().centre_m - board_pose.translation).norm(), 3e-4);
}

}  // namespace
}  // namespace alea
