#pragma once

#include <span>
#include <vector>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// Where a board may lie in a plane. A place of the board is centre + R(angle) * (x, y).
struct BoardPose2 {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double angle_rad = 0;
};

/// A pose with the correlation of the intensities in its outline with the pattern.
struct BoardCandidate {
  BoardPose2 pose;
  double correlation = 0;
  double gain = 0;         ///< log-likelihood over that of one level for all points
  std::size_t points = 0;  ///< in the outline
};

struct BoardSearchOptions {
  Eigen::Vector2d about_m = Eigen::Vector2d::Zero();  ///< of the centres tried
  double radius_m = 0;
  std::size_t most_candidates = 3;
};

/// Every centre within the radius and every angle at which the pattern differs, on a raster of
/// cells / 6 or finer and steps of 3 deg or finer; best first, at least half the shorter side
/// apart. Each pose costs as many additions as the board has columns and rows, because a
/// checkerboard is the product of two square waves. Intensities are clipped to their central 96 %.
std::vector<BoardCandidate> search_board(const BoardSpec& board,
                                         std::span<const Eigen::Vector2d> places_m,
                                         std::span<const float> intensity,
                                         const BoardSearchOptions& options);

/// The correlation at one pose from the points themselves.
BoardCandidate correlate(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                         std::span<const float> intensity, const BoardPose2& pose);

/// A place of the plane in the board's frame.
Eigen::Vector2d on_board(const BoardPose2& pose, const Eigen::Vector2d& place_m);

}  // namespace alea
