#include "alea/facet/facet_points.hpp"

#include <cmath>
#include <string>

#include "alea/core/error.hpp"

namespace alea {
namespace {

bool masked(const std::vector<FacetDisc>& discs, const Eigen::Vector2d& uv_m) {
  for (const FacetDisc& disc : discs)
    if ((uv_m - disc.centre_m).squaredNorm() < disc.radius_m * disc.radius_m) return true;
  return false;
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

std::array<std::vector<std::uint32_t>, 3> select_facet_points(
    std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
    const FacetSelection& selection) {
  const FacetPlacer placer(corner, selection.domain, selection.scanner_position);
  std::array<std::vector<std::uint32_t>, 3> members;
  for (int k = 0; k < 3; ++k) {
    const double margin = selection.trim_m / corner_sine(corner, k);
    const Eigen::Array2d low = Eigen::Array2d::Constant(margin);
    const Eigen::Array2d high = selection.lengths_m[k].array() - margin;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto place = placer.place(k, points[i]);
      if (!place || (selection.nearest_plane && !place->nearest)) continue;
      if (std::abs(place->height_m) > selection.gate_m[k]) continue;
      const Eigen::Array2d uv = place->uv_m.array();
      if ((uv < low).any() || (uv > high).any() || masked(selection.masks[k], place->uv_m))
        continue;
      members[k].push_back(static_cast<std::uint32_t>(i));
    }
  }
  return members;
}

}  // namespace alea
