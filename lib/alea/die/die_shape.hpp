#pragma once

#include <array>
#include <optional>

#include "alea/core/plane.hpp"

namespace alea {

/// The hand of a die: 1, 2, 3 run clockwise or counterclockwise about their common corner, seen
/// from outside.
enum class Chirality { clockwise, counterclockwise };

/// "clockwise" or "counterclockwise".
const char* to_string(Chirality chirality);

/// A die as the planes of its facets, in one frame of its own (metres). facets[pips - 1] has an
/// outward normal and is empty where nothing is known of that facet. Opposite facets sum to seven.
struct DieShape {
  std::array<std::optional<Plane>, 6> facets;

  const std::optional<Plane>& facet(int pips) const { return facets[pips - 1]; }
};

/// A perfect cube centred at the origin: 1 looks along +Z; clockwise 2 along +Y and 3 along +X,
/// counterclockwise the other way round. Throws Error(usage) where the edge is not positive.
DieShape cube(double edge_m, Chirality chirality);

/// Length of the edge where two adjacent facets meet (m), from corner to corner: between the two
/// other facets that it ends at. Empty where one of the four is unknown or they do not meet.
std::optional<double> edge_length_m(const DieShape& shape, int first_pips, int second_pips);

/// The axis of the die that a facet is normal to: 0 for 1 and 6, 1 for 2 and 5, 2 for 3 and 4.
constexpr int die_axis(int pips) {
  return (pips <= 3 ? pips : 7 - pips) - 1;
}
/// +1 for 1, 2, 3 and -1 for 4, 5, 6: the side of its axis that a facet is on.
constexpr int axis_side(int pips) {
  return pips <= 3 ? 1 : -1;
}
constexpr int opposite_pips(int pips) {
  return 7 - pips;
}

}  // namespace alea
