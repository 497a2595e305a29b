#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/facet/facet_corner.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

/// Working copy for the facets of one corner: the points about them, and what the cloud calls them.
struct FacetNeighbourhood {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> indices;  ///< into the cloud, ascending
};

/// All points of the cloud in a ball about the body whose distance from its surface along the
/// facets' normals is at most `depth_m`. `lengths_m` as in FacetSelection.
FacetNeighbourhood points_about(const Cloud& cloud, const FacetCorner& corner,
                                const std::array<Eigen::Vector2d, 3>& lengths_m, double depth_m);

/// Lengths of the three facets along their edges (m) from the regions' points: 99 % quantiles. All
/// zero where a region is empty.
std::array<Eigen::Vector2d, 3> rough_lengths(const Cloud& cloud, const FacetCorner& corner,
                                             const std::array<PlaneRegion, 3>& regions);

}  // namespace alea
