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

FacetMembers select_facet_points(std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
                                 const FacetSelection& selection) {
  const FacetPlacer placer(corner, selection.domain, selection.scanner_position);
  std::array<Eigen::Array2d, 3> low, high;
  for (int k = 0; k < 3; ++k) {
    low[k].setConstant(selection.trim_m / corner_sine(corner, k));
    high[k] = selection.lengths_m[k].array() - low[k];
  }
  FacetMembers members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlacedPoint placed = placer.approach(points[i]);
    for (int k = 0; k < 3; ++k) {
      if (selection.nearest_plane && k != placed.nearest) continue;
      if (std::abs(placed.height_m[k]) > selection.gate_m[k] || !placed.meets[k]) continue;
      const Eigen::Vector2d uv = placer.uv_m(k, points[i], placed);
      if ((uv.array() < low[k]).any() || (uv.array() > high[k]).any()) continue;
      if (!masked(selection.masks[k], uv)) members[k].push_back(static_cast<std::uint32_t>(i));
    }
  }
  return members;
}

}  // namespace alea
