#include "alea/facet/facet_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "alea/core/error.hpp"
#include "alea/facet/pointing.hpp"

namespace alea {
namespace {

bool masked(const std::vector<FacetDisc>& discs, const Eigen::Vector2d& uv_m) {
  for (const FacetDisc& disc : discs)
    if ((uv_m - disc.centre_m).squaredNorm() < disc.radius_m * disc.radius_m) return true;
  return false;
}

/// The part of a facet whose points count, in its uv (m).
struct FacetWindow {
  Eigen::Array2d low, high;
};

FacetWindow window_of(const FacetCorner& corner, int k, const FacetSelection& selection) {
  const double sine = corner_sine(corner, k);
  const Eigen::Array2d lengths = selection.lengths_m[k].array();
  FacetWindow out;
  out.low.setConstant(selection.trim_m / sine);
  out.high = lengths - out.low;
  if (selection.domain != SelectionDomain::ray || !(selection.pointing_rad > 0)) return out;
  const Eigen::Vector3d& normal = corner.planes[k].normal;
  const std::array<Eigen::Vector3d, 2> edges{corner.edges[(k + 1) % 3], corner.edges[(k + 2) % 3]};
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector3d along = edges[1 - axis];  // of the borders that end this axis
    const Eigen::Vector3d across = along.cross(normal).normalized();
    const Eigen::Vector3d middle = corner.corner_m + lengths[1 - axis] / 2 * along;
    const auto margin_m = [&](const Eigen::Vector3d& place) {
      const double sd_m =
          pointing_sd_m(place - selection.scanner_position, normal, across, selection.pointing_rad);
      return std::min(border_pointing_sds * sd_m / sine, lengths[axis] / 4);
    };
    out.low[axis] = std::max(out.low[axis], margin_m(middle));
    out.high[axis] =
        std::min(out.high[axis], lengths[axis] - margin_m(middle + lengths[axis] * edges[axis]));
  }
  return out;
}

}  // namespace

std::vector<FacetDisc> pip_discs(int pips, const Eigen::Vector2d& lengths_m, double radius_m) {
  if (pips < 1 || pips > 6)
    throw usage_error("pip discs: " + std::to_string(pips) + " pips; a facet has 1 to 6");
  std::vector<FacetDisc> discs;
  const auto add = [&](double u, double v) {
    discs.push_back({{u * lengths_m.x(), v * lengths_m.y()}, radius_m});
  };
  if (pips % 2 == 1) add(0.5, 0.5);
  if (pips == 1) return discs;
  for (const double u : {0.25, 0.75})
    for (const double v : {0.25, 0.75}) add(u, v);
  if (pips == 6) add(0.25, 0.5), add(0.75, 0.5), add(0.5, 0.25), add(0.5, 0.75);
  return discs;
}

FacetMembers select_facet_points(std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
                                 const FacetSelection& selection) {
  const FacetPlacer placer(corner, selection.domain, selection.scanner_position);
  const std::array<FacetWindow, 3> windows{window_of(corner, 0, selection),
                                           window_of(corner, 1, selection),
                                           window_of(corner, 2, selection)};
  FacetMembers members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlacedPoint placed = placer.approach(points[i]);
    for (int k = 0; k < 3; ++k) {
      if (selection.nearest_plane && k != placed.nearest) continue;
      if (std::abs(placed.height_m[k]) > selection.gate_m[k] || !placed.meets[k]) continue;
      const Eigen::Vector2d uv = placer.uv_m(k, points[i], placed);
      if ((uv.array() < windows[k].low).any() || (uv.array() > windows[k].high).any()) continue;
      if (!masked(selection.masks[k], uv)) members[k].push_back(static_cast<std::uint32_t>(i));
    }
  }
  return members;
}

}  // namespace alea
