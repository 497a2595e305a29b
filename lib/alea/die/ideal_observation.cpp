#include "alea/die/ideal_observation.hpp"

#include <algorithm>

#include "alea/core/error.hpp"

namespace alea {
namespace {

Plane moved(const Plane& plane, const RigidTransform& to_from_die) {
  const Eigen::Vector3d normal = to_from_die.rotation * plane.normal;
  return {normal, plane.offset_m + normal.dot(to_from_die.translation)};
}

const Plane& known_facet(const DieShape& shape, int pips) {
  const std::optional<Plane>& plane = shape.facet(pips);
  if (!plane) throw usage_error("the die's shape lacks a facet that is asked for");
  return *plane;
}

}  // namespace

PlaneFit exact_fit(const Plane& plane, const Eigen::Vector3d& centre_m,
                   const Eigen::Matrix3d& covariance) {
  PlaneFit fit;
  fit.plane = plane;
  fit.centroid_m = centre_m - plane.normal * plane.signed_distance(centre_m);
  fit.tangent = tangent_basis(plane.normal);
  fit.covariance = covariance;
  return fit;
}

ObservedDie observe_exactly(const DieShape& shape, const std::array<int, 3>& pips,
                            const RigidTransform& scan_from_die,
                            const Eigen::Matrix3d& covariance) {
  std::array<int, 3> sorted = pips;
  std::sort(sorted.begin(), sorted.end());
  ObservedDie die;
  for (int k = 0; k < 3; ++k) {
    const Plane plane = moved(known_facet(shape, sorted[k]), scan_from_die);
    die.facets[k].pips = sorted[k];
    die.facets[k].fit = exact_fit(plane, scan_from_die.translation, covariance);
  }
  return die;
}

std::array<int, 3> facing_pips(const DieShape& shape, const Eigen::Vector3d& scanner_in_die_m) {
  std::array<int, 3> pips{};
  for (int axis = 0; axis < 3; ++axis) {
    const int near = axis + 1;
    const bool faces = known_facet(shape, near).signed_distance(scanner_in_die_m) > 0;
    pips[axis] = faces ? near : opposite_pips(near);
  }
  std::sort(pips.begin(), pips.end());
  return pips;
}

}  // namespace alea
