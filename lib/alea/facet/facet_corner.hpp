#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
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

/// How a point gets its place on a facet.
enum class SelectionDomain {
  ray,         ///< where the scanner's ray through the point meets the plane: by direction only
  coordinate,  ///< the foot of the perpendicular from the measured point
};

/// A point held against the three facets of a corner.
struct PlacedPoint {
  std::array<double, 3> height_m{};  ///< of the measured point over each plane, positive outside
  std::array<double, 3>
      at{};  ///< ray domain: share of the measured range at which the ray meets it
  std::array<bool, 3> meets{};  ///< whether the point has a place on the facet's front
  int nearest = 0;              ///< the facet that the point belongs to where borders meet
};

/// Places points on the facets of a corner. Nearest facet: in the ray domain the one that the ray
/// meets last, which is where it enters a convex body; in the coordinate domain the one whose plane
/// is nearest to the measured point.
class FacetPlacer {
 public:
  FacetPlacer(const FacetCorner& corner, SelectionDomain domain,
              const Eigen::Vector3d& scanner_position);

  PlacedPoint approach(const Eigen::Vector3d& p) const {
    PlacedPoint out;
    const Eigen::Vector3d from_corner = p - corner_.corner_m;
    for (int k = 0; k < 3; ++k) out.height_m[k] = corner_.planes[k].normal.dot(from_corner);
    if (domain_ == SelectionDomain::coordinate) {
      out.meets.fill(true);
      for (int k = 1; k < 3; ++k)
        if (std::abs(out.height_m[k]) < std::abs(out.height_m[out.nearest])) out.nearest = k;
      return out;
    }
    // The ray scanner + t (p - scanner) meets plane k at t = scanner height / (fall along the ray).
    for (int k = 0; k < 3; ++k) {
      const double fall = scanner_height_m_[k] - out.height_m[k];
      out.meets[k] = fall > 0 && scanner_height_m_[k] > 0;
      out.at[k] = out.meets[k] ? scanner_height_m_[k] / fall : 0;
      if (out.at[k] > out.at[out.nearest]) out.nearest = k;
    }
    return out;
  }
  /// Place on facet k along edges[(k+1)%3] and edges[(k+2)%3] from the corner (m).
  Eigen::Vector2d uv_m(int k, const Eigen::Vector3d& p, const PlacedPoint& placed) const {
    const Eigen::Vector3d from_corner = p - corner_.corner_m;
    if (domain_ == SelectionDomain::coordinate) return duals_[k] * from_corner;
    return duals_[k] * (scanner_ + placed.at[k] * (from_corner - scanner_));
  }

 private:
  FacetCorner corner_;
  SelectionDomain domain_;
  Eigen::Vector3d scanner_;  ///< from the corner
  std::array<double, 3> scanner_height_m_{};
  std::array<Eigen::Matrix<double, 2, 3>, 3> duals_;  ///< uv = duals[k] (place - corner)
};

/// Sine of the angle between the two edges of facet k: turns uv into distances from the borders.
double corner_sine(const FacetCorner& corner, int k);

}  // namespace alea
