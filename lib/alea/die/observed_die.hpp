#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "alea/core/plane.hpp"
#include "alea/facet/plane_fit.hpp"

namespace alea {

/// One facet of the die in one scan, in the scan's own frame (metres).
struct ObservedFacet {
  int pips = 0;                        ///< 1 to 6
  PlaneFit fit;                        ///< outward normal
  std::vector<std::uint32_t> indices;  ///< the scan's points that the fit used, ascending
  double pip_probability = 1;          ///< that the pips were read rightly
};

/// The three facets of one corner of the die that a scan sees, in ascending order of pips.
struct ObservedDie {
  std::array<ObservedFacet, 3> facets;
};

/// The facet with these pips, or null.
const ObservedFacet* find_facet(const ObservedDie& die, int pips);

/// The planes in the order of the facets.
std::array<Plane, 3> planes_of(const ObservedDie& die);

/// The pips that both scans see, ascending.
std::vector<int> shared_pips(const ObservedDie& a, const ObservedDie& b);

/// The angle inside the die between two of its facets.
struct DihedralAngle {
  int first_pips = 0;  ///< the smaller
  int second_pips = 0;
  double angle_rad = 0;
};

/// The three dihedral angles of an observed corner: 1-2, 1-3, 2-3 of its facets' order.
std::array<DihedralAngle, 3> dihedral_angles(const ObservedDie& die);

}  // namespace alea
