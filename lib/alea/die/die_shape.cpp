#include "alea/die/die_shape.hpp"

#include "alea/core/error.hpp"

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

}  // namespace alea
