#pragma once

#include "alea/simulate/die_model.hpp"
#include "alea/simulate/ray.hpp"

namespace alea {

/// Moves `hit` to where the ray enters the die, if that is nearer. Closed forms only: slabs for the
/// hexahedron, cylinders and spheres for rounded edges, one quadratic for a bowed facet; pips are
/// discs, sunk by their recess.
void intersect(const Die& die, std::uint32_t index, const Ray& ray, Hit& hit);

/// Whether the ray comes within `margin_m` of the die's six planes' body (or a little farther,
/// about its edges).
bool passes(const Die& die, double margin_m, const Ray& ray);

}  // namespace alea
