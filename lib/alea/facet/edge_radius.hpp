#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "alea/facet/facet_corner.hpp"

namespace alea {

/// Estimates the radius (m) of the rounding along the three edges of a corner, all taken as equal,
/// from the points (m) near them and planes that the rounding did not touch. In the cross-section
/// of an edge, with s and t the difference and the sum over sqrt(2) of the depths below its two
/// planes, a sharp edge is t = |s| and a rounded one t = sqrt(2) R - sqrt(R^2 - s^2); R minimises
/// the squared differences to the mean t in bins of s. A beam's footprint blunts an edge too and is
/// part of the answer. `lengths_m` as in FacetSelection; the largest radius looked for is a seventh
/// of the shortest. Zero where an edge has no points.
double estimate_edge_radius(std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
                            const std::array<Eigen::Vector2d, 3>& lengths_m);

}  // namespace alea
