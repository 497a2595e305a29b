#pragma once

#include <optional>
#include <span>

#include "alea/checkerboard/board_fit.hpp"
#include "alea/core/refusal.hpp"

namespace alea {

/// How well the cells agree with the pattern: pairs of cells side by side whose mean intensities
/// differ the right way; on a board of few cells by a quarter of the mean of such differences.
struct CellPairs {
  int right = 0, seen = 0, all = 0;
};
CellPairs cell_pairs(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                     std::span<const float> intensity, const BoardFit& fit);

/// Refusal no_pattern where the intensities do not show the board: on small boards a single step or
/// a shadow correlates up to 0.58 with the pattern, so that every pair must be right; on larger
/// ones three quarters of very many, and a correlation of 0.35: rings and textures of a wall in a
/// real scan correlate up to 0.25 with some place of a board of 144 cells.
std::optional<Refusal> check_pattern(const BoardSpec& board,
                                     std::span<const Eigen::Vector2d> places_m,
                                     std::span<const float> intensity, const BoardFit& fit);

/// check_pattern for a pose that is right to a hundredth of a cell: 0.7 of the correlation, and no
/// comparison of cells; what it refuses a precise fit cannot save.
std::optional<Refusal> check_roughly(const BoardSpec& board,
                                     std::span<const Eigen::Vector2d> places_m,
                                     std::span<const float> intensity, const BoardFit& fit);

/// Width and height of what looks like the board (m): from its middle, each way, to where the
/// pattern of the last column or row ends, because points end or cells stop alternating.
struct BoardExtent {
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d longer_half_m = Eigen::Vector2d::Zero();  ///< the larger of the two ways
  bool continues = false;  ///< the pattern goes on beyond the outline as on a board of more cells
};
BoardExtent board_extent(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                         std::span<const float> intensity, const BoardFit& fit, double spacing_m);

/// Refusal size_mismatch where the extent differs by more than 15 % of two cells plus one spacing,
/// and, where it is larger, three standard deviations of the blur. Of a 2 x 2 board a part may be
/// hidden: where it is smaller, twice the longer half counts.
std::optional<Refusal> check_size(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                                  std::span<const float> intensity, const BoardFit& fit,
                                  double spacing_m);

}  // namespace alea
