#include "alea/die/facet_adjustment.hpp"

#include <algorithm>

#include "alea/die/plane_match.hpp"

namespace alea {

Eigen::Vector3d approximate_centre(const ObservedDie& die) {
  // The centroid of each facet lies about half an edge inside the two other planes.
  double inside_m = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    for (int other = 0; other < 3; ++other)
      if (other != k)
        inside_m -= die.facets[other].fit.plane.normal.dot(die.facets[k].fit.centroid_m -
                                                           die.facets[other].fit.centroid_m);
    centre += die.facets[k].fit.centroid_m / 3;
  }
  inside_m /= 6;
  for (int k = 0; k < 3; ++k) centre -= die.facets[k].fit.plane.normal * inside_m / 3;
  return centre;
}

ObservedDie recentred(const ObservedDie& die, const Eigen::Vector3d& origin_m) {
  ObservedDie moved = die;
  for (ObservedFacet& facet : moved.facets) facet.fit = recentred(facet.fit, origin_m);
  return moved;
}

}  // namespace alea
