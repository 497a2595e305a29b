#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// A square wave of +1 and -1 over `cells` cells, +1 in the first, blurred by a Gaussian; beyond
/// the last edge it keeps the value of the last cell.
class BlurredWave {
 public:
  BlurredWave(int cells, double cell_m, double blur_m);

  /// The value at a place with its derivatives.
  struct Value {
    double value = 1;
    double by_place = 0;  ///< 1/m
    double by_blur = 0;   ///< 1/m
    double by_cell = 0;   ///< 1/m
  };
  Value at(double place_m) const {
    const double in_cells = place_m * cells_per_m_ + half_cells_;
    // Most places are far from every edge: the nearest inner one (from 1, at k cells) tells.
    const int nearest = static_cast<int>(std::clamp(in_cells + 0.5, 1.0, edges_ + 0.5));
    if (std::abs(in_cells - nearest) <= reach_cells_) return near_edges(place_m, in_cells);
    Value wave;
    wave.value = (in_cells > nearest ? nearest : nearest - 1) % 2 == 0 ? 1 : -1;
    return wave;
  }

 private:
  Value near_edges(double place_m, double in_cells) const;

  int edges_;  ///< inner ones
  double cells_per_m_, half_cells_, cell_m_, reach_cells_;
  double scale_;  ///< 1 / (sqrt2 blur), 1/m
};

/// The pattern of a board seen by a Gaussian beam whose standard deviations along the board's axes
/// are blur_m: value -1 on dark, +1 on light cells, -wave(x) * wave(y), because the blur of a
/// product is the product of the blurs:
///   I(x, y) = mean + contrast / 2 * pattern(x, y),
/// for 2 x 2 cells the pattern is -erf(x / (sqrt2 b)) erf(y / (sqrt2 b)).
class BlurredPattern {
 public:
  BlurredPattern(const BoardSpec& board, const Eigen::Vector2d& blur_m)
      : columns_(board.columns, board.cell_m, blur_m.x()),
        rows_(board.rows, board.cell_m, blur_m.y()) {}

  struct Value {
    double value = 0;
    Eigen::Vector2d by_place = Eigen::Vector2d::Zero();
    Eigen::Vector2d by_blur = Eigen::Vector2d::Zero();
    double by_cell = 0;
    bool flat = true;  ///< so far from every edge that only the value is not zero
  };
  Value at(const Eigen::Vector2d& place_m) const {
    const BlurredWave::Value x = columns_.at(place_m.x()), y = rows_.at(place_m.y());
    Value pattern;
    pattern.value = -x.value * y.value;
    pattern.flat = x.by_place == 0 && y.by_place == 0;
    if (pattern.flat) return pattern;
    pattern.by_place = {-x.by_place * y.value, -x.value * y.by_place};
    pattern.by_blur = {-x.by_blur * y.value, -x.value * y.by_blur};
    pattern.by_cell = -x.by_cell * y.value - x.value * y.by_cell;
    return pattern;
  }

 private:
  BlurredWave columns_, rows_;
};

}  // namespace alea
