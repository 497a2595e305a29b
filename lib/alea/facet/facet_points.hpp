#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "alea/facet/facet_corner.hpp"

namespace alea {

/// A round place on a facet that a fit leaves out (a pip), in the facet's uv (m).
struct FacetDisc {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double radius_m = 0;
};

/// Where the pips of a facet may lie, whichever way the maker turned 2, 3 and 6: centres at a
/// quarter, half and three quarters of the facet's two lengths (m), radius as given (m).
/// Throws Error(usage) for pips outside 1 to 6.
std::vector<FacetDisc> pip_discs(int pips, const Eigen::Vector2d& lengths_m, double radius_m);

/// Which points belong to the facets of a corner.
struct FacetSelection {
  SelectionDomain domain = SelectionDomain::ray;
  Eigen::Vector3d scanner_position = Eigen::Vector3d::Zero();
  bool nearest_plane = true;  ///< a point belongs to its nearest facet only
  double trim_m = 0.01;       ///< least distance from each of the four borders; negative widens
  /// Standard deviation of the rays' pointing. In the ray domain rays nearer to a border than
  /// `border_pointing_sds` of it are left out too, up to a quarter of the facet's length; zero
  /// leaves it at the trim.
  double pointing_rad = 0;
  /// lengths_m[k]: of facet k along edges[(k+1)%3] and edges[(k+2)%3].
  std::array<Eigen::Vector2d, 3> lengths_m;
  std::array<double, 3> gate_m{};  ///< largest distance of a point from its facet's plane
  std::array<std::vector<FacetDisc>, 3> masks;
};

/// Members of the three facets, as indices into the points, ascending.
using FacetMembers = std::array<std::vector<std::uint32_t>, 3>;

/// Indices into `points` (m) of each facet's members, ascending. In the ray domain only the gate
/// looks at the measured range; at 4 standard deviations and centred on the plane it does not bias.
FacetMembers select_facet_points(std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
                                 const FacetSelection& selection);

}  // namespace alea
