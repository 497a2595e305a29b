#include "alea/facet/facet_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "alea/core/error.hpp"
#include "alea/facet/edge_radius.hpp"
#include "alea/facet/facet_neighbourhood.hpp"

namespace alea {
namespace {

constexpr int max_iterations = 10;
constexpr double interior_share = 0.15;  // of an edge, trimmed before the radius is known
constexpr double depth_share = 0.08;  // of an edge: how deep below a plane a rounded edge may lie
constexpr double least_gate_m = 1e-4;

SelectionDomain domain_of(const FacetFitOptions& options) {
  if (options.domain) return *options.domain;
  return options.fit.method == FitMethod::along_ray ? SelectionDomain::ray
                                                    : SelectionDomain::coordinate;
}

std::array<Plane, 3> outward_planes(const std::array<PlaneRegion, 3>& regions,
                                    const std::optional<Eigen::Vector3d>& scanner) {
  std::array<Plane, 3> out;
  for (int k = 0; k < 3; ++k) {
    const PlaneRegion& region = regions[k];
    const Eigen::Vector3d others =
        (regions[(k + 1) % 3].centroid_m + regions[(k + 2) % 3].centroid_m) / 2;
    const bool outward = scanner ? region.plane.signed_distance(*scanner) > 0
                                 : region.plane.signed_distance(others) < 0;
    out[k] = outward ? region.plane : region.plane.flipped();
  }
  return out;
}

/// Everything that one pass of selecting and fitting changes.
struct State {
  FacetCorner corner;
  std::array<PlaneFit, 3> fits;
  std::array<std::vector<std::uint32_t>, 3> members;  // into the neighbourhood
  std::array<double, 3> gate_m{};
};

double robust_scale_m(const FacetNeighbourhood& about, const std::vector<std::uint32_t>& members,
                      const PlaneFit& fit) {
  std::vector<double> heights;
  heights.reserve(members.size());
  for (const std::uint32_t i : members)
    heights.push_back(std::abs(fit.plane.normal.dot(about.points[i] - fit.centroid_m)));
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle / 0.67449;
}

std::optional<Refusal> select_and_fit(const FacetNeighbourhood& about, FacetSelection selection,
                                      const FacetFitOptions& options, State& state) {
  selection.gate_m = state.gate_m;
  state.members = select_facet_points(about.points, state.corner, selection);
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    const auto& members = state.members[k];
    if (members.size() < options.min_points)
      return Refusal{RefusalCode::too_few_points,
                     "a facet has " + std::to_string(members.size()) +
                         " points inside its borders, " + std::to_string(options.min_points) +
                         " are needed; scan the die more densely or from nearer"};
    std::vector<Eigen::Vector3d> points;
    points.reserve(members.size());
    for (const std::uint32_t i : members) points.push_back(about.points[i]);
    state.fits[k] = fit_plane(points, options.fit);
    planes[k] = state.fits[k].plane;
    // Without a scanner the fit cannot know the outside; the first planes did.
    if (state.fits[k].plane.normal.dot(state.corner.planes[k].normal) < 0)
      state.fits[k] = flipped(state.fits[k]);
    planes[k] = state.fits[k].plane;
    state.gate_m[k] = options.gate_m.value_or(std::max(
        least_gate_m, options.gate_sigmas * robust_scale_m(about, members, state.fits[k])));
  }
  const auto corner = facet_corner(planes);
  if (!corner) return Refusal{RefusalCode::no_die, "the facets' planes do not meet in one corner"};
  state.corner = *corner;
  return std::nullopt;
}

/// A point outside the corner from which all three facets are seen, far away.
Eigen::Vector3d lookout(const FacetCorner& corner) {
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
  for (const Plane& plane : corner.planes) outward += plane.normal;
  return corner.corner_m + 1e3 * outward;
}

double shortest(const std::array<FacetExtent, 3>& extents) {
  double out = extents[0].length_m.minCoeff();
  for (const FacetExtent& extent : extents) out = std::min(out, extent.length_m.minCoeff());
  return out;
}

std::array<Eigen::Vector2d, 3> lengths_of(const std::array<FacetExtent, 3>& extents) {
  return {extents[0].length_m, extents[1].length_m, extents[2].length_m};
}

/// Each edge is seen by two facets; the weighted mean of what they say.
void combine_edges(FacetFits& out) {
  for (int j = 0; j < 3; ++j) {
    const FacetExtent &first = out.extents[(j + 2) % 3], &second = out.extents[(j + 1) % 3];
    const double w0 = 1 / std::pow(first.length_sd_m[0], 2);
    const double w1 = 1 / std::pow(second.length_sd_m[1], 2);
    out.edges_m[j] = (w0 * first.length_m[0] + w1 * second.length_m[1]) / (w0 + w1);
    out.edges_sd_m[j] = 1 / std::sqrt(w0 + w1);
  }
}

}  // namespace

Result<FacetFits> fit_facets(const Cloud& cloud, const std::array<PlaneRegion, 3>& regions,
                             const FacetFitOptions& options) {
  const auto& scanner = options.fit.scanner_position;
  if (!scanner && domain_of(options) == SelectionDomain::ray)
    throw usage_error("facet fit: selection by rays needs the scanner's position");
  const auto first = facet_corner(outward_planes(regions, scanner));
  if (!first) return Refusal{RefusalCode::no_die, "the three planes do not meet in one corner"};
  State state{*first, {}, {}, {}};
  const auto rough = rough_lengths(cloud, state.corner, regions);
  double edge = rough[0].minCoeff();
  for (const Eigen::Vector2d& lengths : rough) edge = std::min(edge, lengths.minCoeff());
  if (!(edge > 0))
    return Refusal{RefusalCode::no_die, "the three planes' points do not lie about one corner"};
  const FacetNeighbourhood about = points_about(
      cloud, state.corner, rough, std::max(depth_share * edge, options.gate_m.value_or(0)));

  FacetFits out;
  ExtentOptions extent_options;
  extent_options.scanner_position = scanner.value_or(lookout(state.corner));
  extent_options.footprint_m = options.footprint_m;
  extent_options.inside_gate_m = depth_share * edge / 2;
  out.extents = measure_extents(about.points, state.corner, rough, extent_options);

  FacetSelection selection;
  selection.domain = domain_of(options);
  selection.scanner_position = scanner.value_or(lookout(state.corner));
  selection.lengths_m = lengths_of(out.extents);
  selection.trim_m = interior_share * shortest(out.extents);
  state.gate_m.fill(depth_share * edge);
  if (auto refusal = select_and_fit(about, selection, options, state)) return *refusal;
  out.edge_radius_m = options.edge_radius_m.value_or(
      estimate_edge_radius(about.points, state.corner, selection.lengths_m));
  extent_options.edge_radius_m = out.edge_radius_m;
  out.extents = measure_extents(about.points, state.corner, selection.lengths_m, extent_options);
  combine_edges(out);

  const double least = std::min(options.least_trim_m, shortest(out.extents) / 15);
  out.trim_m = options.trim_m.value_or(std::max({out.edge_radius_m, options.footprint_m, least}));
  selection.trim_m = out.trim_m;
  selection.lengths_m = lengths_of(out.extents);
  selection.nearest_plane = options.nearest_plane;
  selection.masks = options.masks;
  auto previous = state.members;
  do {
    previous = state.members;
    if (auto refusal = select_and_fit(about, selection, options, state)) return *refusal;
  } while (++out.iterations < max_iterations && state.members != previous);

  out.corner = state.corner;
  out.fits = state.fits;
  for (int k = 0; k < 3; ++k)
    for (const std::uint32_t i : state.members[k]) out.indices[k].push_back(about.indices[i]);
  return out;
}

}  // namespace alea
