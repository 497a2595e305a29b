#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "alea/plane/plane_detector.hpp"

namespace alea {

/// Two planes of about the right size that may be neighbouring facets of one die.
struct FacetPair {
  std::array<std::size_t, 2> regions{};               ///< into the plane regions, ascending
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< between the two centroids
  double misfit_m = 0;  ///< of the centroids' distance, against that of neighbouring square facets
};

/// Whether two planes may be neighbouring facets of a die with this longest edge: not far from a
/// right angle and close together.
bool may_adjoin(const PlaneRegion& a, const PlaneRegion& b, double longest_edge_m);

/// All such pairs among the `sized` regions, the one whose distance suits the die best first.
std::vector<FacetPair> facet_pairs(const std::vector<PlaneRegion>& regions,
                                   const std::vector<std::size_t>& sized, double longest_edge_m);

/// Whether the pair is a right angle at the distance of two facets of a cube with this edge.
bool looks_like_a_die(const FacetPair& pair, const std::vector<PlaneRegion>& regions,
                      double edge_m);

}  // namespace alea
