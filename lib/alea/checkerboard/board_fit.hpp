#pragma once

#include <span>

#include "alea/checkerboard/blurred_pattern.hpp"
#include "alea/checkerboard/board_search.hpp"

namespace alea {

struct BoardFitOptions {
  /// Points this far inside the outline at most, in cells: beyond it the surroundings blur in. The
  /// margin is widened to 2.5 standard deviations of the blur, up to 0.3 cells.
  double margin_cells = 0.08;
  bool free_cell = false;   ///< the cell's size too: needs three columns or rows
  bool free_slope = false;  ///< brightness that changes linearly over the board
  double spacing_m = 0;     ///< of the points: a blur below a quarter of it cannot be seen
  /// False: a pose good to a hundredth of a cell, without covariances.
  bool precise = true;
};

/// A blurred-edge fit. Parameters: centre x, y (m), angle (rad), blur along columns and rows (m),
/// mean, half the contrast, cell (m), slope along x and y (1/m); those not estimated are fixed.
struct BoardFit {
  static constexpr int parameters = 10;
  using Covariance = Eigen::Matrix<double, parameters, parameters>;

  BoardPose2 pose;
  Eigen::Vector2d blur_m = Eigen::Vector2d::Zero();
  double mean = 0, half_contrast = 0, cell_m = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  /// Standard deviation of an intensity away from edges, and of the places of points (m): by the
  /// pattern's gradient the latter makes intensities vary more near edges.
  double intensity_sd = 0, place_sd_m = 0;
  /// From the residuals (Huber 1967, the sandwich), zero for what is not estimated.
  Covariance covariance = Covariance::Zero();
  /// Inverse Fisher information of the same points under the two standard deviations.
  Covariance bound = Covariance::Zero();
  std::size_t points = 0;  ///< inside the margin
  bool converged = false;

  double dark() const { return mean - half_contrast; }
  double light() const { return mean + half_contrast; }
};

/// Maximum likelihood of I = mean + half_contrast * pattern + slope . place under intensity noise
/// and jitter of the places, with Huber's weights, from a start that is right to a quarter of a
/// cell: Levenberg-Marquardt steps, points and weights renewed between rounds.
BoardFit fit_board(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                   std::span<const float> intensity, const BoardPose2& start,
                   const BoardFitOptions& options);

/// The same from an earlier fit of the same board, at a pose in the coordinates of these places.
BoardFit improve_fit(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                     std::span<const float> intensity, const BoardFit& earlier,
                     const BoardPose2& start, const BoardFitOptions& options);

}  // namespace alea
