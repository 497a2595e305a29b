#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// Where a board may lie in a plane. A place of the board is centre + R(angle) * (x, y).
struct BoardPose2 {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double angle_rad = 0;
};

/// Places of the plane in the frame of a board.
class OnBoard {
 public:
  explicit OnBoard(const BoardPose2& pose)
      : centre_(pose.centre_m),
        cosine_(std::cos(pose.angle_rad)),
        sine_(std::sin(pose.angle_rad)) {}

  Eigen::Vector2d operator()(const Eigen::Vector2d& place_m) const {
    const Eigen::Vector2d from = place_m - centre_;
    return {cosine_ * from.x() + sine_ * from.y(), -sine_ * from.x() + cosine_ * from.y()};
  }
  double cosine() const { return cosine_; }
  double sine() const { return sine_; }

 private:
  Eigen::Vector2d centre_;
  double cosine_, sine_;
};

/// Within the outline less a margin on all sides (m).
inline bool in_outline(const BoardSpec& board, const Eigen::Vector2d& on_board_m,
                       double margin_m = 0) {
  return std::abs(on_board_m.x()) <= board.side_m() / 2 - margin_m &&
         std::abs(on_board_m.y()) <= board.height_m() / 2 - margin_m;
}

/// A pose with the correlation of the intensities in its outline with the pattern.
struct BoardCandidate {
  BoardPose2 pose;
  double correlation = 0;
  double gain = 0;         ///< log-likelihood over that of one level for all points
  std::size_t points = 0;  ///< in the outline
};

/// The most that the gain of n points can be: it is capped.
double most_gain(std::size_t points);

struct BoardSearchOptions {
  Eigen::Vector2d about_m = Eigen::Vector2d::Zero();  ///< of the centres tried
  double radius_m = 0;
  std::size_t most_candidates = 3;
  static constexpr double least_gain_share = 0.3;  ///< of the best candidate's gain
};

/// Every centre within the radius and every angle at which the pattern differs, on a raster of an
/// eighth of a cell (four columns: a sixth, to eight: a fifth, more: a third) and steps of 3 deg or
/// finer; best first, at least half the shorter side apart, none of less than 0.3 times the best
/// gain. Each pose costs as many additions as the board has columns and rows, because a
/// checkerboard is the product of two square waves. Intensities are clipped to their central 96 %.
std::vector<BoardCandidate> search_board(const BoardSpec& board,
                                         std::span<const Eigen::Vector2d> places_m,
                                         std::span<const float> intensity,
                                         const BoardSearchOptions& options);

/// The correlation at one pose from the points themselves.
BoardCandidate correlate(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                         std::span<const float> intensity, const BoardPose2& pose);
}  // namespace alea
