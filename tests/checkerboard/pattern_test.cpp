#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "alea/checkerboard/blurred_pattern.hpp"
#include "alea/checkerboard/board_raster.hpp"
#include "alea/core/error.hpp"

namespace alea {
namespace {

TEST(BlurredPattern, IsTheProductOfTwoErrorFunctionsOnTwoByTwoCells) {
  const BoardSpec board;
  for (const double x : {-0.05, -0.003, 0.0, 0.001, 0.02}) {
    for (const double y : {-0.01, 0.002, 0.06}) {
      const auto pattern = BlurredPattern(board, {0.004, 0.003}).at({x, y});
      const double expected = -std::erf(x / (std::numbers::sqrt2 * 0.004)) *
                              std::erf(y / (std::numbers::sqrt2 * 0.003));
      EXPECT_NEAR(pattern.value, expected, 1e-5);
    }
  }
}

TEST(BlurredPattern, DerivativesAreThoseOfItsValue) {
  const BoardSpec board{5, 4, 0.05};
  const Eigen::Vector2d blur(0.006, 0.009);
  const double h = 1e-7;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.021, -0.003), Eigen::Vector2d(-0.077, 0.052),
                                    Eigen::Vector2d(0.1, 0.0)}) {
    const auto here = BlurredPattern(board, blur).at(at);
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(k);
      EXPECT_NEAR((BlurredPattern(board, blur).at(at + step).value -
                   BlurredPattern(board, blur).at(at - step).value) /
                      (2 * h),
                  here.by_place[k], 1e-4);
      EXPECT_NEAR((BlurredPattern(board, blur + step).at(at).value -
                   BlurredPattern(board, blur - step).at(at).value) /
                      (2 * h),
                  here.by_blur[k], 1e-3);
    }
    EXPECT_NEAR((BlurredPattern({5, 4, 0.05 + h}, blur).at(at).value -
                 BlurredPattern({5, 4, 0.05 - h}, blur).at(at).value) /
                    (2 * h),
                here.by_cell, 1e-3);
  }
}

TEST(BlurredPattern, SharpEdgesGiveThePatternItself) {
  const BoardSpec board{4, 3, 0.1};
  for (double x = -0.19; x < 0.2; x += 0.037)
    for (double y = -0.14; y < 0.15; y += 0.031)
      EXPECT_NEAR(BlurredPattern(board, {1e-6, 1e-6}).at({x, y}).value, pattern_sign(board, {x, y}),
                  1e-9);
}

TEST(BoardWindows, AreTheSumsOverTheCellsOfEachOutline) {
  BoardRaster raster(17, 15);
  for (int k = 0; k < 400; ++k)  // quarters: sums in any order are exact
    raster.add(k * 7 % 17, k * 11 % 15, static_cast<float>(k * k % 9 - 4) / 4);
  for (const BoardSpec& board : {BoardSpec{2, 2, 1}, BoardSpec{4, 3, 1}, BoardSpec{5, 4, 1}}) {
    const int cell_px = 3;
    const BoardWindows windows(raster, board, cell_px);
    ASSERT_EQ(windows.width(), 17 - 3 * board.columns + 1);
    ASSERT_EQ(windows.height(), 15 - 3 * board.rows + 1);
    for (int y = 0; y < windows.height(); ++y) {
      for (int x = 0; x < windows.width(); ++x) {
        Eigen::Array4d plain = Eigen::Array4d::Zero(), alternating = Eigen::Array4d::Zero();
        for (int v = 0; v < board.rows * cell_px; ++v)
          for (int u = 0; u < board.columns * cell_px; ++u) {
            plain += raster.at(x + u, y + v);
            alternating +=
                ((u / cell_px + v / cell_px) % 2 == 0 ? 1 : -1) * raster.at(x + u, y + v);
          }
        EXPECT_TRUE((windows.plain(x, y) == plain).all()) << x << " " << y;
        EXPECT_TRUE((windows.alternating(x, y) == alternating.head<2>()).all()) << x << " " << y;
      }
    }
  }
  EXPECT_EQ(BoardWindows(raster, {6, 5, 1}, 3).width(), 0);
}

TEST(Board, TemplateHasAsManyDarkAsLightPointsOnEvenCells) {
  const Cloud cloud = board_template({2, 2, 0.5}, 20);
  EXPECT_EQ(cloud.size(), 400u);
  double sum = 0;
  for (const float value : cloud.intensity) sum += value;
  EXPECT_EQ(sum, 200);
  EXPECT_LT(cloud.intensity[0], 0.5f);  // the first cell is dark
}

TEST(Board, OtsuSeparatesTwoLevels) {
  std::vector<float> values;
  for (int i = 0; i < 300; ++i) values.push_back(static_cast<float>(20 + i % 7));
  for (int i = 0; i < 100; ++i) values.push_back(static_cast<float>(200 + i % 9));
  const double threshold = otsu_threshold(values);
  EXPECT_GT(threshold, 27);
  EXPECT_LT(threshold, 200);
  EXPECT_EQ(otsu_threshold({5, 5, 5}), 5);
  EXPECT_THROW(otsu_threshold({}), Error);
}

TEST(Board, ColourScoreCountsPointsWithoutNeighbourAsMisses) {
  const Cloud board = board_template({2, 2, 0.5}, 10);
  EXPECT_EQ(colour_score(board, board, 0.5, 0.01), 1);
  Cloud away = board, inverted = board;
  for (Eigen::Vector3d& p : away.positions) p.x() += 3;
  for (float& value : inverted.intensity) value = 1 - value;
  EXPECT_EQ(colour_score(board, away, 0.5, 0.15), 0);
  EXPECT_EQ(colour_score(board, inverted, 0.5, 0.01), 0);
}

TEST(Board, RefusesBoardsThatCannotBe) {
  EXPECT_THROW(require_valid({1, 1, 0.1}), Error);
  EXPECT_THROW(require_valid({2, 3, 0.1}), Error);
  EXPECT_THROW(require_valid({2, 2, 0}), Error);
}

}  // namespace
}  // namespace alea
