#include "alea/facet/facet_fit.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "alea/cloud/coordinate_step.hpp"
#include "alea/core/error.hpp"
#include "alea/facet/edge_radius.hpp"
#include "alea/facet/facet_neighbourhood.hpp"

namespace alea {
namespace {

constexpr int max_iterations = 12, interior_passes = 2;
constexpr double settled_m = 1e-7, settled_rad = 1e-7;
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

/// What an iteration of selecting and fitting goes on with.
struct State {
  FacetCorner corner;
  std::array<double, 3> gate_m{};
};

using Members = std::array<std::vector<Eigen::Vector3d>, 3>;

double robust_scale_m(const std::vector<Eigen::Vector3d>& members, const Plane& plane,
                      const Eigen::Vector3d& near) {
  const double offset = plane.signed_distance(near);
  std::vector<double> heights;
  heights.reserve(members.size());
  for (const Eigen::Vector3d& p : members)
    heights.push_back(std::abs(plane.normal.dot(p - near) + offset));
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle / 0.67449;
}

std::optional<Refusal> check_members(const FacetMembers& members, std::size_t min_points) {
  for (const auto& facet : members)
    if (facet.size() < min_points)
      return Refusal{RefusalCode::too_few_points,
                     "a facet has " + std::to_string(facet.size()) +
                         " points inside its borders, " + std::to_string(min_points) +
                         " are needed; scan the die more densely or from nearer"};
  return std::nullopt;
}

Members points_of(const FacetNeighbourhood& about, const FacetMembers& members) {
  Members out;
  for (int k = 0; k < 3; ++k) {
    out[k].reserve(members[k].size());
    for (const std::uint32_t i : members[k]) out[k].push_back(about.points[i]);
  }
  return out;
}

/// Of a facet along the axes rounding may leave all heights equal but a few, a step or two off: a
/// narrower gate would keep them on one side only and tilt the plane.
double least_gate(std::span<const Eigen::Vector3d> points) {
  return std::max(least_gate_m, 3 * coordinate_step_m(points));
}

/// Improves the planes once by their members; empty where they no longer meet in a corner.
std::optional<State> improve(const Members& members, const FacetFitOptions& options,
                             const State& before) {
  std::array<Plane, 3> planes;
  State after;
  for (int k = 0; k < 3; ++k) {
    planes[k] = improve_plane(members[k], before.corner.planes[k], options.fit);
    // Without a scanner the fit cannot know the outside; the first planes did.
    if (planes[k].normal.dot(before.corner.planes[k].normal) < 0) planes[k] = planes[k].flipped();
    after.gate_m[k] = options.gate_m.value_or(std::max(
        least_gate(members[k]),
        options.gate_sigmas * robust_scale_m(members[k], planes[k], before.corner.corner_m)));
  }
  const auto corner = facet_corner(planes);
  if (!corner) return std::nullopt;
  after.corner = *corner;
  return after;
}

bool settled(const State& before, const State& after) {
  bool out = (before.corner.corner_m - after.corner.corner_m).norm() < settled_m;
  for (int k = 0; k < 3; ++k)
    out &= (before.corner.planes[k].normal - after.corner.planes[k].normal).norm() < settled_rad;
  return out;
}

/// Selects and improves until nothing changes or `passes` are done.
struct Iterated {
  State state;
  FacetMembers members;
  int passes = 0;
};
Result<Iterated> iterate(const FacetNeighbourhood& about, FacetSelection selection,
                         const FacetFitOptions& options, const State& start, int passes) {
  Iterated out{start, {}, 0};
  while (out.passes < passes) {
    selection.gate_m = out.state.gate_m;
    out.members = select_facet_points(about.points, out.state.corner, selection);
    if (auto refusal = check_members(out.members, options.min_points)) return *refusal;
    const auto next = improve(points_of(about, out.members), options, out.state);
    if (!next) return Refusal{RefusalCode::no_die, "the facets' planes do not meet in one corner"};
    const bool done = settled(out.state, *next);
    out.state = *next;
    ++out.passes;
    if (done) break;
  }
  return out;
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

std::array<Eigen::Vector2d, 3> borders_of(const std::array<FacetExtent, 3>& extents) {
  return {extents[0].border_m, extents[1].border_m, extents[2].border_m};
}

/// Each edge is seen by two facets: the weighted mean of what they say. Spacing averages out, what
/// the silhouette hides does not.
void combine_edges(FacetFits& out) {
  for (int j = 0; j < 3; ++j) {
    const FacetExtent &first = out.extents[(j + 2) % 3], &second = out.extents[(j + 1) % 3];
    const double w0 = 1 / std::pow(first.sampling_sd_m[0], 2);
    const double w1 = 1 / std::pow(second.sampling_sd_m[1], 2);
    out.edges_m[j] = (w0 * first.length_m[0] + w1 * second.length_m[1]) / (w0 + w1);
    const double hidden = std::max(first.hidden_sd_m[0], second.hidden_sd_m[1]);
    out.edges_sd_m[j] = std::sqrt(1 / (w0 + w1) + hidden * hidden);
  }
}

/// Edge radius, extents and the trim that they ask for, from planes that the borders did not touch.
void measure_body(const FacetNeighbourhood& about, const FacetFitOptions& options,
                  ExtentOptions extent_options, const std::array<Eigen::Vector2d, 3>& lengths_m,
                  const State& state, FacetFits& out) {
  out.edge_radius_m =
      options.edge_radius_m.value_or(estimate_edge_radius(about.points, state.corner, lengths_m));
  extent_options.edge_radius_m = out.edge_radius_m;
  extent_options.outside_gate_m = *std::max_element(state.gate_m.begin(), state.gate_m.end()) / 2;
  out.extents = measure_extents(about.points, state.corner, lengths_m, extent_options);
  combine_edges(out);
  const double least = std::min(options.least_trim_m, shortest(out.extents) / 15);
  out.trim_m = options.trim_m.value_or(std::max({out.edge_radius_m, options.footprint_m, least}));
}

void fit_members(const Members& members, const FacetFitOptions& options, const FacetCorner& corner,
                 FacetFits& out) {
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    out.fits[k] = fit_plane(members[k], corner.planes[k], options.fit);
    if (out.fits[k].plane.normal.dot(corner.planes[k].normal) < 0)
      out.fits[k] = flipped(out.fits[k]);
    planes[k] = out.fits[k].plane;
  }
  out.corner = facet_corner(planes).value_or(corner);
}

FacetSelection final_selection(const FacetFits& body, const FacetFitOptions& options,
                               const Eigen::Vector3d& scanner_position) {
  FacetSelection out;
  out.domain = domain_of(options);
  out.scanner_position = scanner_position;
  out.nearest_plane = options.nearest_plane;
  out.trim_m = body.trim_m;
  out.pointing_rad = options.fit.noise.angular_noise_rad;
  out.lengths_m = borders_of(body.extents);
  out.masks = options.masks;
  return out;
}

/// Iterates from `start` to the end and describes the facets in `out`.
Result<FacetFits> fit_selected(const FacetNeighbourhood& about, const FacetSelection& selection,
                               const FacetFitOptions& options, const State& start, FacetFits out) {
  const auto result = iterate(about, selection, options, start, max_iterations);
  if (!result) return result.refusal();
  out.iterations = result->passes;
  fit_members(points_of(about, result->members), options, result->state.corner, out);
  for (int k = 0; k < 3; ++k)
    for (const std::uint32_t i : result->members[k]) out.indices[k].push_back(about.indices[i]);
  return out;
}

}  // namespace

Result<FacetFits> fit_facets(const Cloud& cloud, const std::array<PlaneRegion, 3>& regions,
                             const FacetFitOptions& options) {
  const auto& scanner = options.fit.scanner_position;
  if (!scanner && domain_of(options) == SelectionDomain::ray)
    throw usage_error("facet fit: selection by rays needs the scanner's position");
  const auto first = facet_corner(outward_planes(regions, scanner));
  if (!first) return Refusal{RefusalCode::no_die, "the three planes do not meet in one corner"};
  State state{*first, {}};
  const auto rough = rough_lengths(cloud, state.corner, regions);
  double edge = rough[0].minCoeff();
  for (const Eigen::Vector2d& lengths : rough) edge = std::min(edge, lengths.minCoeff());
  if (!(edge > 0))
    return Refusal{RefusalCode::no_die, "the three planes' points do not lie about one corner"};
  const FacetNeighbourhood about = points_about(
      cloud, state.corner, rough, std::max(depth_share * edge, options.gate_m.value_or(0)));

  FacetFits out;
  out.corner = state.corner;
  ExtentOptions extent_options;
  extent_options.scanner_position = scanner.value_or(lookout(state.corner));
  extent_options.footprint_m = options.footprint_m;
  extent_options.inside_gate_m = depth_share * edge / 2;
  out.extents = measure_extents(about.points, state.corner, rough, extent_options);

  FacetSelection selection;
  selection.domain = domain_of(options);
  selection.scanner_position = extent_options.scanner_position;
  selection.lengths_m = borders_of(out.extents);
  selection.trim_m = interior_share * shortest(out.extents);
  state.gate_m.fill(depth_share * edge);
  const auto interior = iterate(about, selection, options, state, interior_passes);
  if (!interior) return interior.refusal();
  state = interior->state;
  measure_body(about, options, extent_options, selection.lengths_m, state, out);

  selection = final_selection(out, options, selection.scanner_position);
  return fit_selected(about, selection, options, state, std::move(out));
}

Result<FacetFits> refit_facets(const Cloud& cloud, const FacetFits& before,
                               const FacetFitOptions& options) {
  FacetFits out = before;
  for (auto& indices : out.indices) indices.clear();
  State state{before.corner, {}};
  const double least_m = least_gate(cloud.positions);
  double widest = 0;
  for (int k = 0; k < 3; ++k) {
    state.gate_m[k] =
        options.gate_m.value_or(std::max(least_m, options.gate_sigmas * before.fits[k].rmse_m));
    widest = std::max(widest, state.gate_m[k]);
  }
  const auto about = points_about(cloud, before.corner, borders_of(before.extents), 2 * widest);
  const Eigen::Vector3d from = options.fit.scanner_position.value_or(lookout(before.corner));
  return fit_selected(about, final_selection(before, options, from), options, state,
                      std::move(out));
}

}  // namespace alea
