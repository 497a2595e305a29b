#include "alea/die/die_shape.hpp"

#include "alea/core/error.hpp"
#include "alea/die/assembly.hpp"

namespace alea {

const char* to_string(Chirality chirality) {
  return chirality == Chirality::clockwise ? "clockwise" : "counterclockwise";
}

DieShape cube(double edge_m, Chirality chirality) {
  if (!(edge_m > 0)) throw usage_error("cube: the edge must be a positive length in metres");
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const bool clockwise = chirality == Chirality::clockwise;
  const std::array<Eigen::Vector3d, 3> normals{Eigen::Vector3d::UnitZ(), clockwise ? y : x,
                                               clockwise ? x : y};
  DieShape shape;
  for (int pips = 1; pips <= 6; ++pips)
    shape.facets[pips - 1] = Plane{axis_side(pips) * normals[die_axis(pips)], edge_m / 2};
  return shape;
}

std::optional<double> edge_length_m(const DieShape& shape, int first_pips, int second_pips) {
  const int axis = 3 - die_axis(first_pips) - die_axis(second_pips);  // the one that it runs along
  if (die_axis(first_pips) == die_axis(second_pips))
    throw usage_error("edge length: opposite facets have no common edge");
  const auto &first = shape.facet(first_pips), &second = shape.facet(second_pips);
  const auto &near = shape.facet(axis + 1), &far = shape.facet(opposite_pips(axis + 1));
  if (!first || !second || !near || !far) return std::nullopt;
  const auto at_near = assemble_corner({*first, *second, *near});
  const auto at_far = assemble_corner({*first, *second, *far});
  if (!at_near || !at_far) return std::nullopt;
  return (at_near->corner_m - at_far->corner_m).norm();
}

}  // namespace alea
