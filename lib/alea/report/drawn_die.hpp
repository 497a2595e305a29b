#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/facet/facet_corner.hpp"
#include "alea/pipeline/observe_die.hpp"

namespace alea {

/// Three facets about a corner as a report draws them, read or not, in the scan's frame.
struct DrawnDie {
  FacetCorner corner;
  std::array<double, 3> edges_m{};                 ///< lengths of corner.edges
  std::array<std::vector<std::uint32_t>, 3> used;  ///< points that the fits used
  std::array<int, 3> pips{};                       ///< 0 where they could not be read
  std::array<double, 3> probability{};
  std::array<double, 3> rmse_m{};  ///< along the normal
  double trim_m = 0;
  /// The facets as the pip readers saw them: before the pips were masked.
  std::array<std::vector<std::uint32_t>, 3> read;

  Eigen::Vector3d centre_m() const;
  double longest_edge_m() const;
  /// The eight corners of the parallelepiped that the three edges span; bit k of the index is set
  /// where edge k has been walked.
  std::array<Eigen::Vector3d, 8> corners_m() const;
};

/// The die that a scan's sighting or, where nothing could be read, its best candidate shows; empty
/// where there is neither. `sighting` overrides which of the sightings.
std::optional<DrawnDie> drawn_die(const ScanSighting& scan, const DieSighting* sighting = nullptr);

/// What became of a point near a facet.
enum class FacetPointFate { used, border, pip_mask, off_plane };

/// The points about one facet, placed on it.
struct FacetView {
  std::vector<Eigen::Vector2d> uv_m;
  std::vector<std::uint32_t> indices;
  std::vector<double> height_m;  ///< over the fitted plane, positive outside
  std::vector<FacetPointFate> fate;
};

/// Sorts the points about the die by facet, as far as they lie within 3 cm of its plane and a tenth
/// of an edge around it.
std::array<FacetView, 3> facet_views(const Cloud& cloud, const DrawnDie& die);

}  // namespace alea
