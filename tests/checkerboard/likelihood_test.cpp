#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <set>

#include "alea/checkerboard/board_finder.hpp"
#include "alea/checkerboard/coloured_measurement.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/simulate/board_sensor.hpp"
#include "tests/checkerboard/printed_board.hpp"

namespace alea {
namespace {

/// The board's frame before it is turned: it faces the scanner, rows up, at a distance along x.
RigidTransform facing(double range_m, const Eigen::Vector3d& turn_rad = {0, 0, 0}) {
  RigidTransform pose;
  pose.rotation << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  pose.rotation = pose.rotation * rotation_exp({turn_rad.x(), turn_rad.y(), 0}) *
                  rotation_exp({0, 0, turn_rad.z()});
  pose.translation = {range_m, 0.2, -0.1};
  return pose;
}

Cloud survey_scan(const Checkerboard& board, const RigidTransform& pose, std::uint64_t trial = 1) {
  return scan_board(board, pose, survey_sensor(), {31, 0, trial, 0, Purpose::test});
}

TEST(BoardLikelihood, FindsTheCentreNearItsBoundWhereverItIsLookedFor) {
  const BoardSpec board;
  double squares = 0, bound = 0, nees = 0;
  constexpr int trials = 24;
  for (int t = 0; t < trials; ++t) {
    RandomStream stream({32, 0, static_cast<std::uint64_t>(t), 0, Purpose::test});
    const RigidTransform pose =
        facing(10, {0.3 * stream.uniform(), -0.3 * stream.uniform(), 6.28 * stream.uniform()});
    const Eigen::Vector3d near =
        pose.translation + 0.08 * Eigen::Vector3d(stream.normal(), stream.normal(), 0).normalized();
    const auto result =
        measure_by_likelihood(survey_scan(printed(board), pose, t), near, options_for(board));
    ASSERT_TRUE(result) << result.refusal().message;
    const Eigen::Vector3d error = result->centre_m - pose.translation;
    squares += error.squaredNorm();
    bound += result->bound->trace();
    nees += error.dot(result->covariance->inverse() * error);
    EXPECT_GT(result->normal.dot(pose.rotation.col(2)), 0.9999);
    EXPECT_GT(std::abs(result->axes.col(0).dot(pose.rotation.col(0))), 0.999);
    EXPECT_EQ(result->alternatives.size(), 1u);
  }
  EXPECT_LT(std::sqrt(squares / bound), 1.5);  // sd of the ratio: 1 / sqrt(6 * 24) = 8 %
  EXPECT_NEAR(nees / (3 * trials), 1, 4 * std::sqrt(2.0 / (3 * trials)));
}

TEST(BoardLikelihood, MeasuresTheCellOfABoardOfManyCells) {
  const BoardSpec board{6, 5, 0.04};
  const RigidTransform pose = facing(8, {0.2, 0.1, 0.4});
  const auto result = measure_by_likelihood(survey_scan(printed(board), pose), pose.translation,
                                            options_for(board));
  ASSERT_TRUE(result) << result.refusal().message;
  EXPECT_LT((result->centre_m - pose.translation).norm(), 4e-4);
  EXPECT_TRUE(result->cell_estimated);
  EXPECT_NEAR(result->cell_m, 0.04, 1e-4);
  // 6 + 5 is odd: half a turn swaps dark and light, so the axes are known.
  EXPECT_TRUE(result->alternatives.empty());
  EXPECT_GT(result->axes.col(0).dot(pose.rotation.col(0)), 0.999);
}

TEST(BoardLikelihood, IgnoresAWallBehindAndAPlateAround) {
  const BoardSpec board;
  for (const double plate : {0.0, 0.5, 0.9}) {
    Checkerboard in_wall = printed(board);
    in_wall.margin_m = 0.2;
    in_wall.plate_intensity = plate;
    const RigidTransform pose = facing(10, {0.1, -0.2, 0.7});
    const auto result =
        measure_by_likelihood(survey_scan(in_wall, pose), pose.translation, options_for(board));
    ASSERT_TRUE(result) << result.refusal().message;
    EXPECT_LT((result->centre_m - pose.translation).norm(), 5e-4);
  }
}

TEST(BoardLikelihood, GivesTheSameBitsForAnyOrderAndThreadCount) {
  const BoardSpec board;
  const RigidTransform pose = facing(10, {0.2, 0.1, 0.3});
  const Cloud cloud = survey_scan(printed(board), pose);
  std::vector<std::uint32_t> order(cloud.size());
  for (std::uint32_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<std::uint32_t>((i * 7919ull + 13) % order.size());
  Cloud shuffled = subset(cloud, order);
  ASSERT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), order.size());
  shuffled.scanner_position = cloud.scanner_position;
  const auto reference = measure_by_likelihood(cloud, pose.translation, options_for(board));
  const ThreadLimit one(1);
  const auto other = measure_by_likelihood(shuffled, pose.translation, options_for(board));
  ASSERT_TRUE(reference && other);
  EXPECT_EQ(reference->centre_m, other->centre_m);
  EXPECT_EQ(*reference->covariance, *other->covariance);
}

TEST(BoardLikelihood, RefusesWhatIsNoBoardOfThisSize) {
  const BoardSpec board;
  const RigidTransform pose = facing(10, {0.2, 0.1, 0.3});
  const auto code_of = [&](const Checkerboard& scene, const BoardSpec& asked) {
    const auto result =
        measure_by_likelihood(survey_scan(scene, pose), pose.translation, options_for(asked));
    return result ? std::string("measured") : std::string(to_string(result.refusal().code));
  };
  Checkerboard blank = printed(board), faint = printed(board);
  blank.dark_intensity = blank.light_intensity = blank.plate_intensity = 0.6;
  faint.dark_intensity = 0.50;
  faint.light_intensity = 0.51;
  EXPECT_EQ(code_of(blank, board), "no_pattern");
  EXPECT_EQ(code_of(faint, board), "no_pattern");
  for (const double factor : {1.3, 1 / 1.3}) {
    for (const double margin : {0.0, 0.1}) {
      Checkerboard scene = printed(board);
      scene.margin_m = margin;
      EXPECT_EQ(code_of(scene, {2, 2, factor * board.cell_m}), "size_mismatch")
          << factor << " " << margin;
    }
  }
  EXPECT_EQ(code_of(printed({4, 4, 0.0375}), {2, 2, 0.0375}), "size_mismatch");
  Cloud three = subset(survey_scan(printed(board), pose), {0, 900, 1800});
  const auto few = measure_by_likelihood(three, pose.translation, options_for(board));
  ASSERT_FALSE(few);
  EXPECT_EQ(few.refusal().code, RefusalCode::too_few_points);
}

TEST(BoardLikelihood, NeedsIntensities) {
  Cloud cloud;
  cloud.positions.emplace_back(1, 0, 0);
  EXPECT_THROW(measure_by_likelihood(cloud, {1, 0, 0}, {}), Error);
}

TEST(ColouredBoard, ThePublishedPipelineFindsTheCentreAndOtsuMatters) {
  const BoardSpec board;
  double all = 0, raw = 0;
  for (int t = 0; t < 4; ++t) {
    const RigidTransform pose = facing(10, {0.1 * t, -0.1, 0.1});
    const Cloud cloud = survey_scan(printed(board), pose, t);
    ColouredBoardOptions steps;
    const auto error = [&]() {
      const auto result = measure_by_coloured_icp(
          cloud, pose.translation + Eigen::Vector3d(0, 0.01, 0.01), options_for(board), steps);
      return result ? (result->centre_m - pose.translation).norm() : 1.0;
    };
    all = std::max(all, error());
    steps.binarise = false;
    raw = std::max(raw, error());
  }
  EXPECT_LT(all, 2e-3);
  EXPECT_GT(raw, all);
}

TEST(BoardFinder, FindsEveryBoardAmongOtherThings) {
  const BoardSpec board;
  Cloud scene;
  std::vector<Eigen::Vector3d> centres;
  for (int k = 0; k < 3; ++k) {
    RigidTransform pose = facing(10, {0.1, 0.1 * k, 0.3 * k});
    pose.translation += Eigen::Vector3d(0.3 * k, 0.9 * k, 0.4 * (k % 2));
    centres.push_back(pose.translation);
    const Cloud one = survey_scan(printed(board), pose, 10 + k);
    scene.positions.insert(scene.positions.end(), one.positions.begin(), one.positions.end());
    scene.intensity.insert(scene.intensity.end(), one.intensity.begin(), one.intensity.end());
  }
  Checkerboard plain = printed(board);  // a plate without pattern
  plain.dark_intensity = plain.light_intensity = 0.9;
  const Cloud blank = survey_scan(plain, facing(12), 20);
  scene.positions.insert(scene.positions.end(), blank.positions.begin(), blank.positions.end());
  scene.intensity.insert(scene.intensity.end(), blank.intensity.begin(), blank.intensity.end());
  const auto found = find_boards(scene, options_for(board));
  ASSERT_TRUE(found) << found.refusal().message;
  EXPECT_EQ(found->size(), 3u);
  for (const Eigen::Vector3d& centre : centres) {
    double nearest = 1;
    for (const BoardMeasurement& one : *found)
      nearest = std::min(nearest, (one.centre_m - centre).norm());
    EXPECT_LT(nearest, 5e-4);
  }
}

}  // namespace
}  // namespace alea
