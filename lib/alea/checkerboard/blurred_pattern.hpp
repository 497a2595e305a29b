#pragma once

#include <Eigen/Core>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// A square wave of +1 and -1 over `cells` cells, +1 in the first, blurred by a Gaussian; beyond
/// the last edge it keeps the value of the last cell. With its derivatives.
struct BlurredWave {
  double value = 1;
  double by_place = 0;  ///< 1/m
  double by_blur = 0;   ///< 1/m
  double by_cell = 0;   ///< 1/m
};
BlurredWave blurred_wave(double place_m, int cells, double cell_m, double blur_m);

/// The pattern of a board seen by a Gaussian beam whose standard deviations along the board's axes
/// are blur_m: value -1 on dark, +1 on light cells, -wave(x) * wave(y), because the blur of a
/// product is the product of the blurs:
///   I(x, y) = mean + contrast / 2 * pattern(x, y),
/// for 2 x 2 cells the pattern is -erf(x / (sqrt2 b)) erf(y / (sqrt2 b)).
struct BlurredPattern {
  double value = 0;
  Eigen::Vector2d by_place = Eigen::Vector2d::Zero();
  Eigen::Vector2d by_blur = Eigen::Vector2d::Zero();
  double by_cell = 0;
  bool flat = true;  ///< so far from every edge that only the value is not zero
};
BlurredPattern blurred_pattern(const BoardSpec& board, const Eigen::Vector2d& place_m,
                               const Eigen::Vector2d& blur_m);

}  // namespace alea
