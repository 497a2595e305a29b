#pragma once

#include <Eigen/Core>
#include <array>

namespace alea {

/// Pips sit on a 3 x 3 lattice about the facet's centre: place 3 * row + column, row and column 0,
/// 1, 2 at -offset, 0, +offset.
inline constexpr int pip_places = 9;

/// Where place `place` lies on a facet, as a share of its edges, from the corner; `offset` is the
/// lattice's spacing as a share of each edge.
inline Eigen::Vector2d pip_place(int place, const Eigen::Vector2d& offset) {
  return {0.5 + offset.x() * (place % 3 - 1), 0.5 + offset.y() * (place / 3 - 1)};
}

/// The same with one share for both edges.
inline Eigen::Vector2d pip_place(int place, double offset) {
  return pip_place(place, Eigen::Vector2d(offset, offset));
}

/// One way of showing a number: bit i of `places` says that place i carries a pip.
struct PipPattern {
  int pips;
  unsigned places;

  bool has(int place) const { return ((places >> place) & 1u) != 0; }
};

/// Every pattern that a facet can show. All are unchanged by half a turn; 1, 4 and 5 by a quarter
/// turn too, while 2, 3 and 6 have two forms, and which one a maker prints is not standardised.
inline constexpr std::array<PipPattern, 9> pip_patterns{{
    {1, 0b000'010'000},
    {2, 0b100'000'001},
    {2, 0b001'000'100},
    {3, 0b100'010'001},
    {3, 0b001'010'100},
    {4, 0b101'000'101},
    {5, 0b101'010'101},
    {6, 0b101'101'101},
    {6, 0b111'000'111},
}};

}  // namespace alea
