#include <CGAL/intersections.h>
#include <CGAL/number_utils.h>

#include <algorithm>

#include "alea/cgal/kernels.hpp"
#include "alea/die/hexahedron.hpp"

namespace alea {
namespace {

std::optional<Exact::Point_3> common_point(const Exact::Plane_3& a, const Exact::Plane_3& b,
                                           const Exact::Plane_3& c) {
  const auto meet = CGAL::intersection(a, b, c);
  if (!meet) return std::nullopt;
  const Exact::Point_3* point = alternative<Exact::Point_3>(*meet);
  return point != nullptr ? std::optional(*point) : std::nullopt;
}

}  // namespace

std::array<int, 3> facets_of_corner(int corner) {
  std::array<int, 3> facets{};
  for (int axis = 0; axis < 3; ++axis) facets[axis] = (corner >> axis & 1) != 0 ? 5 - axis : axis;
  return facets;
}

std::optional<Hexahedron> assemble_hexahedron(const std::array<Plane, 6>& planes) {
  std::array<Exact::Plane_3, 6> exact;
  std::transform(planes.begin(), planes.end(), exact.begin(),
                 [](const Plane& plane) { return to_exact(plane); });
  Hexahedron body;
  body.planes = planes;
  for (int c = 0; c < 8; ++c) {
    const std::array<int, 3> facets = facets_of_corner(c);
    const auto corner = common_point(exact[facets[0]], exact[facets[1]], exact[facets[2]]);
    if (!corner) return std::nullopt;
    for (const int facet : facets)
      if (!exact[5 - facet].has_on_negative_side(*corner)) return std::nullopt;
    body.corners_m[c] = to_double(*corner);
  }
  body.orientation = static_cast<int>(CGAL::orientation(
      exact[0].orthogonal_vector(), exact[1].orthogonal_vector(), exact[2].orthogonal_vector()));
  return body;
}

}  // namespace alea
