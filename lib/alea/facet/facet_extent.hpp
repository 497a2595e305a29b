#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "alea/facet/facet_corner.hpp"

namespace alea {

/// How far a facet reaches from the corner along its two edges, u and v (m).
struct FacetExtent {
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();   ///< least u and v of the facet's points
  Eigen::Vector2d high_m = Eigen::Vector2d::Zero();  ///< where the surface seen from here ends
  /// Where the sharp facet would end if the beam were thin: what a trim is measured from.
  Eigen::Vector2d border_m = Eigen::Vector2d::Zero();
  /// From the corner to the far border of the sharp facet: high_m and, where the facet ends in a
  /// silhouette, what edge radius and footprint hide. Where a surface goes on from the border (the
  /// floor under the die) nothing is hidden.
  Eigen::Vector2d length_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d sampling_sd_m = Eigen::Vector2d::Zero();  ///< of the length, from the spacing
  Eigen::Vector2d hidden_sd_m = Eigen::Vector2d::Zero();    ///< and from what is hidden
};

struct ExtentOptions {
  Eigen::Vector3d scanner_position = Eigen::Vector3d::Zero();
  double edge_radius_m = 0;
  double footprint_m = 0.008;     ///< beam diameter on the facet
  double outside_gate_m = 0.005;  ///< points farther outside their facet do not belong to it
  double inside_gate_m = 0.02;  ///< points deeper than this neither (deep enough for the rounding)
};

/// The share of an edge radius that a scanner does not see at a facet's far border: the ray that
/// touches the rounding meets the facet's plane by this much before the sharp border.
/// `incidence_rad` is measured in the plane across the border.
double hidden_share(double incidence_rad);

/// Measures the three facets of a corner from the points (m) about it, sorted by their rays
/// whatever the fit will use. The end of a facet is found by area: each point stands for
/// rho^2 / cos(incidence), and the area beyond a reference line over the area per metre before it
/// gives the length without the bias of a maximum. Only the stretch that hangs together with the
/// rough lengths' middle counts, so that a coplanar surface beyond a gap does not.
std::array<FacetExtent, 3> measure_extents(std::span<const Eigen::Vector3d> points,
                                           const FacetCorner& corner,
                                           const std::array<Eigen::Vector2d, 3>& rough_lengths_m,
                                           const ExtentOptions& options);

}  // namespace alea
