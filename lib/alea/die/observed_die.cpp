#include "alea/die/observed_die.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace alea {

const ObservedFacet* find_facet(const ObservedDie& die, int pips) {
  for (const ObservedFacet& facet : die.facets)
    if (facet.pips == pips) return &facet;
  return nullptr;
}

std::array<Plane, 3> planes_of(const ObservedDie& die) {
  return {die.facets[0].fit.plane, die.facets[1].fit.plane, die.facets[2].fit.plane};
}

std::vector<int> shared_pips(const ObservedDie& a, const ObservedDie& b) {
  std::vector<int> shared;
  for (int pips = 1; pips <= 6; ++pips)
    if (find_facet(a, pips) != nullptr && find_facet(b, pips) != nullptr) shared.push_back(pips);
  return shared;
}

std::array<DihedralAngle, 3> dihedral_angles(const ObservedDie& die) {
  const auto between = [&](int i, int j) {
    const Eigen::Vector3d& a = die.facets[i].fit.plane.normal;
    const Eigen::Vector3d& b = die.facets[j].fit.plane.normal;
    return DihedralAngle{die.facets[i].pips, die.facets[j].pips,
                         std::numbers::pi - std::atan2(a.cross(b).norm(), a.dot(b))};
  };
  return {between(0, 1), between(0, 2), between(1, 2)};
}

}  // namespace alea
