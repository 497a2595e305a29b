#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/plane.hpp"
#include "alea/die/assembly.hpp"

namespace alea {

/// The points of one facet in the facet's own plane: what the pip readers look at.
struct FacetImageInput {
  /// Metres from the corner along the facet's two edges: the facet is [0, edge_u_m] x [0,
  /// edge_v_m].
  std::vector<Eigen::Vector2d> uv_m;
  std::vector<float> intensity;  ///< as long as uv_m, any unit; non-finite values are skipped
  double edge_u_m = 0;
  double edge_v_m = 0;
  /// Direction of the line of sight in the facet, times the tangent of the incidence angle at the
  /// facet's centre: a footprint d wide is drawn out by d times this. Zero where the scanner's
  /// position is unknown.
  Eigen::Vector2d view_slope = Eigen::Vector2d::Zero();
};

/// The intensities that count, in the scan's own unit; empty (high not above low) where all are
/// equal.
struct IntensityRange {
  double low = 0;
  double high = 0;
};

/// The range that holds all but one in 200 values at either end: a few glints must not decide the
/// scale. A single pip covers five times as much. Non-finite values are skipped.
IntensityRange intensity_range(const std::vector<float>& intensity);

/// Expresses the points of the three facets of a corner along the corner's edges. `indices[k]` are
/// points of `planes[k]` (outward normals), `corner` is the assembly of these planes in this order,
/// `edges_m[k]` the length of corner.edges[k]. Facet k runs along edges (k+1)%3 and (k+2)%3. Throws
/// Error(input) for a cloud without intensity.
std::array<FacetImageInput, 3> facet_images(
    const Cloud& cloud, const std::array<std::span<const std::uint32_t>, 3>& indices,
    const std::array<Plane, 3>& planes, const CornerAssembly& corner,
    const std::array<double, 3>& edges_m);

}  // namespace alea
