#pragma once

#include <optional>

#include "alea/core/refusal.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/observed_die.hpp"

namespace alea {

/// Which hand a registration accepts.
enum class HandRule { clockwise, counterclockwise, any };

/// Whether three pip numbers meet at a corner: each from 1 to 6, no two on the same axis.
bool labels_meet_at_a_corner(int first_pips, int second_pips, int third_pips);

/// The hand of an observed corner, from the exact sign of the determinant of its three outward
/// normals; empty where they lie in one plane. Throws Error(usage) where the labels do not meet at
/// a corner.
std::optional<Chirality> hand_of(const ObservedDie& die);

/// The hand of a shape, from any corner of which all three facets are known; empty where there is
/// none.
std::optional<Chirality> hand_of(const DieShape& shape);

/// A refusal (`mirrored`, `chirality` or `dihedral`) where the two observations cannot be of one
/// die that `rule` accepts: its hand differs between the scans, is not the asked one, or two facets
/// meet more than 20 deg from a right angle. Empty where all is well.
std::optional<Refusal> check_pair(const ObservedDie& master, const ObservedDie& slave,
                                  HandRule rule);

}  // namespace alea
