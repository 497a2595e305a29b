#include "alea/report/drawn_die.hpp"

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

constexpr double shown_height_m = 0.03, shown_margin = 0.1;  // the margin as a share of the edge

/// The rest of a die whose corner, edges and points are known.
void add_reading(const DieCandidate& candidate, const DieSighting& sighting, DrawnDie& die) {
  for (int k = 0; k < 3; ++k) {
    const ObservedFacet& facet = sighting.die.facets[k];
    die.pips[k] = facet.pips;
    die.probability[k] = facet.pip_probability;
    die.rmse_m[k] = facet.fit.rmse_m;
    die.used[k] = facet.indices;
    for (int from = 0; from < 3; ++from)
      if (candidate.regions[from] == sighting.regions[k])
        die.read[k] = candidate.facets.indices[from];
  }
}

/// Masks of the facets whose pips were read, in each facet's uv.
std::vector<FacetDisc> mask_of(const DrawnDie& die, int k) {
  if (die.pips[k] == 0) return {};
  const Eigen::Vector2d lengths(die.edges_m[(k + 1) % 3], die.edges_m[(k + 2) % 3]);
  return pip_discs(die.pips[k], lengths, pip_mask_radius_share * lengths.minCoeff());
}

FacetPointFate fate_of(const std::vector<FacetDisc>& mask, const Eigen::Vector2d& uv_m,
                       double heights_in_rmse) {
  for (const FacetDisc& disc : mask)
    if ((uv_m - disc.centre_m).norm() < disc.radius_m) return FacetPointFate::pip_mask;
  return std::abs(heights_in_rmse) < 4 ? FacetPointFate::border : FacetPointFate::off_plane;
}

}  // namespace

Eigen::Vector3d DrawnDie::centre_m() const {
  const auto corners = corners_m();
  return (corners.front() + corners.back()) / 2;
}

double DrawnDie::longest_edge_m() const {
  return *std::max_element(edges_m.begin(), edges_m.end());
}

std::array<Eigen::Vector3d, 8> DrawnDie::corners_m() const {
  std::array<Eigen::Vector3d, 8> corners;
  for (unsigned bits = 0; bits < 8; ++bits) {
    corners[bits] = corner.corner_m;
    for (unsigned k = 0; k < 3; ++k)
      if ((bits >> k & 1U) != 0) corners[bits] += edges_m[k] * corner.edges[k];
  }
  return corners;
}

std::optional<DrawnDie> drawn_die(const ScanSighting& scan, const DieSighting* sighting) {
  if (sighting == nullptr && !scan.dice.empty()) sighting = &scan.dice.front();
  if (scan.candidates.empty()) return std::nullopt;
  const DieCandidate& candidate = scan.candidates[sighting != nullptr ? sighting->candidate : 0];
  DrawnDie die;
  die.trim_m = candidate.facets.trim_m;
  if (sighting != nullptr) {
    const auto corner = facet_corner(planes_of(sighting->die));
    if (!corner) return std::nullopt;
    die.corner = *corner;
    die.edges_m = sighting->edges_m;
    add_reading(candidate, *sighting, die);
    return die;
  }
  die.corner = candidate.facets.corner;
  die.edges_m = candidate.facets.edges_m;
  die.used = die.read = candidate.facets.indices;
  for (int k = 0; k < 3; ++k) die.rmse_m[k] = candidate.facets.fits[k].rmse_m;
  return die;
}

std::array<FacetView, 3> facet_views(const Cloud& cloud, const DrawnDie& die) {
  const FacetPlacer placer(die.corner, SelectionDomain::coordinate, Eigen::Vector3d::Zero());
  const Eigen::Vector3d centre = die.centre_m();
  const double reach_m = 1.2 * die.longest_edge_m();
  std::array<FacetView, 3> views;
  const std::array<std::vector<FacetDisc>, 3> masks{mask_of(die, 0), mask_of(die, 1),
                                                    mask_of(die, 2)};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    if ((p - centre).squaredNorm() > reach_m * reach_m) continue;
    const PlacedPoint placed = placer.approach(p);
    const int k = placed.nearest;
    if (std::abs(placed.height_m[k]) > shown_height_m) continue;
    const Eigen::Vector2d uv = placer.uv_m(k, p, placed);
    const Eigen::Array2d lengths(die.edges_m[(k + 1) % 3], die.edges_m[(k + 2) % 3]);
    if ((uv.array() < -shown_margin * lengths).any() ||
        (uv.array() > (1 + shown_margin) * lengths).any())
      continue;
    const auto index = static_cast<std::uint32_t>(i);
    const bool used = std::binary_search(die.used[k].begin(), die.used[k].end(), index);
    views[k].uv_m.push_back(uv);
    views[k].indices.push_back(index);
    views[k].height_m.push_back(placed.height_m[k]);
    views[k].fate.push_back(used ? FacetPointFate::used
                                 : fate_of(masks[k], uv, placed.height_m[k] / die.rmse_m[k]));
  }
  return views;
}

}  // namespace alea
