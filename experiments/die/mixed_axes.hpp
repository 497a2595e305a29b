#pragma once

#include "alea/core/rigid_transform.hpp"
#include "alea/die/observed_die.hpp"

namespace alea::experiments::die {

/// The trap of a letter: the shared edge fixed at both stations, but the second axis from the upper
/// facet at one and from the shared side at the other. Takes where the corner comes to lie from a
/// registration by the shared edge. Two shared facets.
RigidTransform turn_by_mixed_axes(const ObservedDie& master, const ObservedDie& slave,
                                  const RigidTransform& by_shared_edge);

}  // namespace alea::experiments::die
