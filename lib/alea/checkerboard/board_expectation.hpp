#pragma once

#include "alea/checkerboard/board_fit.hpp"

namespace alea {

/// Derivatives by the parameters of a BoardFit, in its order.
using BoardRow = Eigen::Matrix<double, BoardFit::parameters, 1>;

struct ExpectedIntensity {
  double value = 0;                 ///< expected intensity
  double jitter_factor = 0;         ///< squared gradient of it, 1/m^2
  BoardRow row = BoardRow::Zero();  ///< derivatives
};

/// Huber's limit, in standard deviations.
inline constexpr double board_huber = 2.0;

/// Of an intensity about what is expected: its own noise, and the jitter of the place.
inline double intensity_variance(const BoardFit& fit, const ExpectedIntensity& model) {
  return fit.intensity_sd * fit.intensity_sd +
         fit.place_sd_m * fit.place_sd_m * model.jitter_factor;
}

/// Expected intensity of a place and its derivatives; those by parameters that are fixed stay zero.
class BoardExpectation {
 public:
  BoardExpectation(const BoardSpec& board, const BoardFit& fit, const BoardFitOptions& options)
      : pattern_({board.columns, board.rows, fit.cell_m}, fit.blur_m),
        fit_(fit),
        options_(options),
        on_board_(fit.pose) {}

  Eigen::Vector2d on_board(const Eigen::Vector2d& place) const { return on_board_(place); }

  BlurredPattern::Value pattern(const Eigen::Vector2d& on_board_m) const {
    return pattern_.at(on_board_m);
  }
  /// The expected intensity alone.
  double value(const Eigen::Vector2d& on_board_m, double pattern) const {
    return fit_.mean + fit_.half_contrast * pattern + fit_.slope.dot(on_board_m);
  }

  ExpectedIntensity at(const Eigen::Vector2d& on_board_m) const {
    return at(on_board_m, pattern(on_board_m));
  }
  ExpectedIntensity at(const Eigen::Vector2d& on_board_m,
                       const BlurredPattern::Value& pattern) const {
    const double half = fit_.half_contrast;
    ExpectedIntensity model;
    model.value = value(on_board_m, pattern.value);
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
      const double c = on_board_.cosine(), s = on_board_.sine();
      model.row[0] = -(c * gradient.x() - s * gradient.y());
      model.row[1] = -(s * gradient.x() + c * gradient.y());
      model.row[2] = gradient.x() * on_board_m.y() - gradient.y() * on_board_m.x();
    }
    return model;
  }

 private:
  BlurredPattern pattern_;
  const BoardFit& fit_;
  const BoardFitOptions& options_;
  OnBoard on_board_;
};

}  // namespace alea
