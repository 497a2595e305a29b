#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "alea/core/plane.hpp"

namespace alea {

/// Three facets about one corner of a convex body, in doubles: the geometry that points are sorted
/// by. (Where a decision depends on the corner, die/assembly.hpp decides it exactly.)
struct FacetCorner {
  std::array<Plane, 3> planes;  ///< outward normals
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  /// edges[k] is where facets (k+1)%3 and (k+2)%3 meet: unit vector from the corner along the body.
  std::array<Eigen::Vector3d, 3> edges;
};

/// Empty where two of the planes are parallel within 1e-6 rad or all three share a direction.
std::optional<FacetCorner> facet_corner(const std::array<Plane, 3>& planes);

/// A point as seen from one facet.
struct FacetPlace {
  Eigen::Vector2d uv_m;  ///< along edges[(k+1)%3] and edges[(k+2)%3], from the corner
  double height_m = 0;   ///< of the measured point over the facet's plane, positive outside
  bool nearest = false;  ///< no other facet is nearer
};

/// How a point gets its place on a facet.
enum class SelectionDomain {
  ray,         ///< where the scanner's ray through the point meets the plane: by direction only
  coordinate,  ///< the foot of the perpendicular from the measured point
};

/// Places points on the facets of a corner. Nearest facet: in the ray domain the one that the ray
/// meets last, which is where it enters a convex body; in the coordinate domain the one whose plane
/// is nearest to the measured point.
class FacetPlacer {
 public:
  FacetPlacer(const FacetCorner& corner, SelectionDomain domain,
              const Eigen::Vector3d& scanner_position);

  /// The place of point p (m) on facet k; empty where its ray does not meet the facet's front.
  std::optional<FacetPlace> place(int k, const Eigen::Vector3d& p) const;

 private:
  FacetCorner corner_;
  SelectionDomain domain_;
  Eigen::Vector3d scanner_;
  std::array<double, 3> scanner_height_m_;
  /// uv = duals[k]^T (p - corner).
  std::array<Eigen::Matrix<double, 3, 2>, 3> duals_;
};

/// Sine of the angle between the two edges of facet k: turns uv into distances from the borders.
double corner_sine(const FacetCorner& corner, int k);

}  // namespace alea
