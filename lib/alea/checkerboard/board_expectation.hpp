#pragma once

#include <cmath>

#include "alea/checkerboard/board_fit.hpp"

namespace alea {

/// Derivatives by the parameters of a BoardFit, in its order.
using BoardRow = Eigen::Matrix<double, BoardFit::parameters, 1>;

struct ExpectedIntensity {
  double value = 0;                 ///< expected intensity
  double jitter_factor = 0;         ///< squared gradient of it, 1/m^2
  BoardRow row = BoardRow::Zero();  ///< derivatives
};

/// Expected intensity of a place and its derivatives; those by parameters that are fixed stay zero.
class BoardExpectation {
 public:
  BoardExpectation(const BoardSpec& board, const BoardFit& fit, const BoardFitOptions& options)
      : board_{board.columns, board.rows, fit.cell_m},
        fit_(fit),
        options_(options),
        cosine_(std::cos(fit.pose.angle_rad)),
        sine_(std::sin(fit.pose.angle_rad)) {}

  Eigen::Vector2d on_board(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d from = place - fit_.pose.centre_m;
    return {cosine_ * from.x() + sine_ * from.y(), -sine_ * from.x() + cosine_ * from.y()};
  }

  ExpectedIntensity at(const Eigen::Vector2d& on_board_m) const {
    const BlurredPattern pattern = blurred_pattern(board_, on_board_m, fit_.blur_m);
    const double half = fit_.half_contrast;
    ExpectedIntensity model;
    model.value = fit_.mean + half * pattern.value + fit_.slope.dot(on_board_m);
    model.row[5] = 1;
    model.row[6] = pattern.value;
    if (options_.free_slope) model.row.tail<2>() = on_board_m;
    Eigen::Vector2d gradient = fit_.slope;
    if (!pattern.flat) {
      gradient += half * pattern.by_place;
      model.jitter_factor = gradient.squaredNorm();
      model.row.segment<2>(3) = half * pattern.by_blur;
      if (options_.free_cell) model.row[7] = half * pattern.by_cell;
    }
    if (!pattern.flat || options_.free_slope) {
      model.row[0] = -(cosine_ * gradient.x() - sine_ * gradient.y());
      model.row[1] = -(sine_ * gradient.x() + cosine_ * gradient.y());
      model.row[2] = gradient.x() * on_board_m.y() - gradient.y() * on_board_m.x();
    }
    return model;
  }

 private:
  BoardSpec board_;
  const BoardFit& fit_;
  const BoardFitOptions& options_;
  double cosine_, sine_;
};

}  // namespace alea
