#pragma once

#include <vector>

#include "alea/checkerboard/board_fit.hpp"
#include "alea/checkerboard/board_plane.hpp"
#include "alea/checkerboard/measurement.hpp"

namespace alea {

/// The board on its own plane.
struct FittedBoard {
  BoardPoints points;
  BoardPlane plane;
  std::vector<Eigen::Vector2d> places;
  BoardFit fit;
  double spacing_m = 0;
};

/// The measurement in the scan's frame: centre, covariance and bound, axes, scores.
BoardMeasurement described(const FittedBoard& fitted, const BoardSpec& board);

}  // namespace alea
