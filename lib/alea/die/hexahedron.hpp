#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "alea/core/plane.hpp"

namespace alea {

/// A closed convex body of six planes that meet like those of a cube. Facet index = pips - 1, so
/// that facets f and 5 - f are opposite.
struct Hexahedron {
  std::array<Plane, 6> planes;  ///< outward normals, as given
  /// Corner c lies on the facets `facets_of_corner(c)`; rounded once from the exact point (metres).
  std::array<Eigen::Vector3d, 8> corners_m;
  /// Exact sign of det(n1, n2, n3): +1 where 1, 2, 3 run counterclockwise seen from outside.
  int orientation = 0;
};

/// The facets that meet in corner 0..7: axis a = 0, 1, 2 gives facet 5 - a where bit a of `corner`
/// is set, else facet a. Corner 0 is that of one, two and three pips.
std::array<int, 3> facets_of_corner(int corner);

/// The body bounded by six planes with outward normals, opposite ones being f and 5 - f. Empty
/// unless the exact kernel finds it closed and convex with the incidence of a cube: each of the
/// eight corners exists and lies strictly inside the three planes that do not pass through it.
/// (Then every edge line of a corner ends in another corner, so the eight are all vertices.)
std::optional<Hexahedron> assemble_hexahedron(const std::array<Plane, 6>& planes);

}  // namespace alea
