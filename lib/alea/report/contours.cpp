#include "alea/report/contours.hpp"

#include <array>

namespace alea {
namespace {

struct Node {
  Eigen::Vector2d place;
  double above;  ///< value minus level
};

/// Crossings of the four sides of a square, in order round it.
std::vector<Eigen::Vector2d> crossings(const std::array<Node, 4>& square) {
  std::vector<Eigen::Vector2d> found;
  for (std::size_t k = 0; k < 4; ++k) {
    const Node& a = square[k];
    const Node& b = square[(k + 1) % 4];
    if ((a.above < 0) == (b.above < 0)) continue;
    found.push_back(a.place + (b.place - a.place) * (a.above / (a.above - b.above)));
  }
  return found;
}

}  // namespace

std::vector<ContourPiece> contour_pieces(std::span<const double> values, int columns, int rows,
                                         double level) {
  std::vector<ContourPiece> pieces;
  const auto node = [&](int column, int row) {
    return Node{Eigen::Vector2d(column, row),
                values[static_cast<std::size_t>(row) * columns + column] - level};
  };
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      const std::array<Node, 4> square{node(column, row), node(column + 1, row),
                                       node(column + 1, row + 1), node(column, row + 1)};
      const std::vector<Eigen::Vector2d> cuts = crossings(square);
      if (cuts.size() == 2) pieces.emplace_back(cuts[0], cuts[1]);
      if (cuts.size() != 4) continue;
      double mean = 0;
      for (const Node& corner : square) mean += corner.above;
      // The first node is cut off by itself unless the middle lies on its side.
      const bool joined = (mean < 0) == (square[0].above < 0);
      pieces.emplace_back(cuts[0], cuts[joined ? 1 : 3]);
      pieces.emplace_back(cuts[2], cuts[joined ? 3 : 1]);
    }
  return pieces;
}

}  // namespace alea
