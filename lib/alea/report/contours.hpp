#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

namespace alea {

/// A piece of a contour line, in columns and rows of the grid.
using ContourPiece = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Where a field on a grid passes `level`, by linear interpolation between its nodes (marching
/// squares; a saddle is cut by the mean of its four nodes). `values` row by row.
std::vector<ContourPiece> contour_pieces(std::span<const double> values, int columns, int rows,
                                         double level);

}  // namespace alea
