#pragma once

#include <Eigen/Core>

#include "alea/core/cloud.hpp"

namespace alea {

/// A checkerboard of square cells, columns >= rows. Board frame: x along the columns, y along the
/// rows, the pattern's centre at the origin; cell (0, 0), at the least x and y, is dark.
struct BoardSpec {
  int columns = 2;
  int rows = 2;
  double cell_m = 0.075;

  double side_m() const { return columns * cell_m; }  ///< the longer side
  double height_m() const { return rows * cell_m; }
  int cells() const { return columns * rows; }
  /// So few that a step or a shadow can look like it: every cell must be seen.
  bool few_cells() const { return cells() < 12; }
  /// The pattern is the same after half a turn; else half a turn swaps dark and light.
  bool half_turn_symmetric() const { return (columns + rows) % 2 == 0; }
  /// The outline is the same after a quarter turn.
  bool square() const { return columns == rows; }
  /// The pattern is the same after a quarter turn (an odd number of cells along both sides).
  bool quarter_turn_symmetric() const { return square() && columns % 2 == 1; }
};

/// Throws Error(usage) for fewer than 2 x 2 cells, more than 1000, rows > columns, or a cell that
/// is not positive.
void require_valid(const BoardSpec& board);

/// -1 on the dark cells, +1 on the light ones, continued beyond the outline.
int pattern_sign(const BoardSpec& board, const Eigen::Vector2d& place_m);

/// Points at the centres of a grid over the board, `points_along_side` along the columns and as
/// many per metre along the rows: intensity 0 on dark and 1 on light cells, normals +z, z = 0.
Cloud board_template(const BoardSpec& board, int points_along_side);

/// The cloud with an intensity for each point: its own, unless all are equal and it has colours;
/// else the mean of its colours in [0, 1].
/// Throws Error(input) where it has neither.
Cloud with_intensity(Cloud cloud);

/// The threshold between two classes of values that makes the variance between them largest, over a
/// histogram of 128 bins. Otsu 1979, doi 10.1109/TSMC.1979.4310076. Throws Error(usage) for no
/// values.
double otsu_threshold(const std::vector<float>& values);

/// Share of template points that have a target point within `gate_m` of the same class, light or
/// dark about the thresholds; a template point without neighbour counts as a miss.
double colour_score(const Cloud& board_in_target_frame, const Cloud& target,
                    double target_threshold, double gate_m);

}  // namespace alea
