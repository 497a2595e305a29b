#include "alea/die/die_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "alea/core/error.hpp"
#include "alea/plane/exact_predicates.hpp"

namespace alea {
namespace {

// First look, on the detector's planes: wide enough that a bad die is named, not overlooked.
constexpr double least_size_share = 0.25, largest_size_share = 2.2;
constexpr double same_place = 0.5;  // of the shortest edge: one die found twice
constexpr std::size_t max_triples = 64;

std::array<double, 3> sorted_edges(const DieFinderOptions& options) {
  std::array<double, 3> edges{options.edge_m, options.edge_m, options.edge_m};
  if (options.edges_m) edges = *options.edges_m;
  std::sort(edges.begin(), edges.end());
  if (!(edges[0] > 0)) throw usage_error("die finder: the expected edge must be positive");
  return edges;
}

std::string text(const char* format, double first, double second = 0) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, first, second);
  return buffer.data();
}

Plane towards(const Plane& plane, const std::optional<Eigen::Vector3d>& scanner) {
  return scanner && plane.signed_distance(*scanner) < 0 ? plane.flipped() : plane;
}

/// The regions whose size suits a facet and which lie where the die is looked for.
std::vector<std::size_t> facet_sized(const Cloud& cloud, const std::vector<PlaneRegion>& regions,
                                     const DieFinderOptions& options) {
  const auto edges = sorted_edges(options);
  const double radius = options.near_radius_m > 0 ? options.near_radius_m : 2 * edges[2];
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (options.near_m && (regions[i].centroid_m - *options.near_m).norm() > radius + edges[2])
      continue;
    const double size = square_edge_m(cloud, regions[i]);
    if (size > least_size_share * edges[0] && size < largest_size_share * edges[2])
      out.push_back(i);
  }
  return out;
}

using Triple = std::array<std::size_t, 3>;

bool makes_corner(const std::vector<PlaneRegion>& regions, const Triple& triple,
                  const std::optional<Eigen::Vector3d>& scanner) {
  std::array<Plane, 3> planes;
  std::array<Eigen::Vector3d, 3> centres;
  for (int k = 0; k < 3; ++k) {
    const PlaneRegion& region = regions[triple[k]];
    const Eigen::Vector3d others =
        (regions[triple[(k + 1) % 3]].centroid_m + regions[triple[(k + 2) % 3]].centroid_m) / 2;
    planes[k] = towards(region.plane, scanner);
    if (!scanner && planes[k].signed_distance(others) > 0) planes[k] = planes[k].flipped();
    centres[k] = region.centroid_m;
  }
  return decide_corner(planes, centres, scanner).accepted();
}

/// Share of a grid of cells on each facet that carries points.
std::array<double, 3> coverage_of(const Cloud& cloud, const FacetFits& facets,
                                  const std::optional<Eigen::Vector3d>& scanner) {
  const FacetPlacer placer(facets.corner,
                           scanner ? SelectionDomain::ray : SelectionDomain::coordinate,
                           scanner.value_or(Eigen::Vector3d::Zero()));
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k) {
    const auto n = facets.indices[k].size();
    const int side = n > 900 ? 8 : n > 200 ? 4 : 2;
    std::vector<char> hit(static_cast<std::size_t>(side * side), 0);
    const Eigen::Array2d low = Eigen::Array2d::Constant(facets.trim_m);
    const Eigen::Array2d span = facets.extents[k].border_m.array() - 2 * low;
    for (const std::uint32_t i : facets.indices[k]) {
      const Eigen::Vector3d& p = cloud.positions[i];
      const Eigen::Vector2d uv = placer.uv_m(k, p, placer.approach(p));
      const Eigen::Array2i cell =
          ((uv.array() - low) / span * side).floor().cast<int>().max(0).min(side - 1);
      hit[static_cast<std::size_t>(cell.x() * side + cell.y())] = 1;
    }
    out[k] = static_cast<double>(std::count(hit.begin(), hit.end(), 1)) / (side * side);
  }
  return out;
}

DieCandidate describe(const Cloud& cloud, const Triple& triple, const FacetFits& facets,
                      const DieFinderOptions& options) {
  DieCandidate out;
  out.regions = triple;
  out.facets = facets;
  out.coverage = coverage_of(cloud, facets, options.facets.fit.scanner_position);
  out.centre_m = facets.corner.corner_m;
  std::array<int, 3> by_length{0, 1, 2};
  std::sort(by_length.begin(), by_length.end(),
            [&](int a, int b) { return facets.edges_m[a] < facets.edges_m[b]; });
  const auto expected = sorted_edges(options);
  for (int rank = 0; rank < 3; ++rank) {
    const int j = by_length[rank];
    out.size_error[j] = facets.edges_m[j] / expected[rank] - 1;
  }
  for (int j = 0; j < 3; ++j) {
    out.centre_m += 0.5 * facets.edges_m[j] * facets.corner.edges[j];
    const Eigen::Vector3d& a = facets.fits[(j + 1) % 3].plane.normal;
    const Eigen::Vector3d& b = facets.fits[(j + 2) % 3].plane.normal;
    out.dihedral_rad[j] = std::numbers::pi - std::atan2(a.cross(b).norm(), a.dot(b));
    const double skew = (out.dihedral_rad[j] - std::numbers::pi / 2) / (std::numbers::pi / 90);
    out.score += std::pow(out.size_error[j] / 0.05, 2) + skew * skew +
                 std::pow((1 - out.coverage[j]) / 0.1, 2);
  }
  return out;
}

std::optional<Refusal> why_not(const DieCandidate& die, const DieFinderOptions& options) {
  for (int j = 0; j < 3; ++j) {
    const double degrees = die.dihedral_rad[j] * 180 / std::numbers::pi;
    if (std::abs(die.dihedral_rad[j] - std::numbers::pi / 2) > options.max_dihedral_error_rad)
      return Refusal{
          RefusalCode::dihedral,
          text("two facets meet at %.1f deg, a die's at 90 +- %.0f deg; this body is not "
               "a die",
               degrees, options.max_dihedral_error_rad * 180 / std::numbers::pi)};
    const double expected = die.facets.edges_m[j] / (1 + die.size_error[j]);
    const double smaller = std::min(expected, die.facets.edges_m[j]);
    const double slack = options.max_size_error * smaller + die.facets.edges_sd_m[j];
    if (std::abs(die.facets.edges_m[j] - expected) > slack)
      return Refusal{RefusalCode::size_mismatch,
                     text("the body found has an edge of %.3f m where %.3f m is expected; check "
                          "--edge and its unit",
                          die.facets.edges_m[j], expected)};
  }
  for (int k = 0; k < 3; ++k)
    if (die.coverage[k] < options.min_coverage)
      return Refusal{RefusalCode::no_die,
                     text("points cover %.0f %% of a facet where %.0f %% is needed; the die is "
                          "hidden in part, or this is no die",
                          100 * die.coverage[k], 100 * options.min_coverage)};
  return std::nullopt;
}

std::vector<Triple> corner_triples(const std::vector<PlaneRegion>& regions,
                                   const std::vector<std::size_t>& sized,
                                   const DieFinderOptions& options) {
  const double longest = sorted_edges(options)[2];
  std::vector<Triple> out;
  for (std::size_t a = 0; a < sized.size(); ++a)
    for (std::size_t b = a + 1; b < sized.size(); ++b) {
      if (!may_adjoin(regions[sized[a]], regions[sized[b]], longest)) continue;
      for (std::size_t c = b + 1; c < sized.size(); ++c) {
        const Triple triple{sized[a], sized[b], sized[c]};
        if (may_adjoin(regions[triple[0]], regions[triple[2]], longest) &&
            may_adjoin(regions[triple[1]], regions[triple[2]], longest) &&
            makes_corner(regions, triple, options.facets.fit.scanner_position))
          out.push_back(triple);
      }
    }
  const auto spread = [&](const Triple& t) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += (regions[t[k]].centroid_m - regions[t[(k + 1) % 3]].centroid_m).norm();
    return std::abs(sum - 3 * std::numbers::sqrt2 / 2 * longest);
  };
  std::stable_sort(out.begin(), out.end(),
                   [&](const Triple& s, const Triple& t) { return spread(s) < spread(t); });
  if (out.size() > max_triples) out.resize(max_triples);
  return out;
}

/// A pair that shows a die where no rejected body stands: both planes of a facet's size, neither a
/// part of such a body.
bool any_lone_pair(const Cloud& cloud, const std::vector<PlaneRegion>& regions,
                   const DieSearch& search, const std::array<double, 3>& edges) {
  constexpr double size_share = 0.25;
  const auto of_a_body = [&](std::size_t region) {
    return std::any_of(search.rejected.begin(), search.rejected.end(), [&](const RejectedDie& die) {
      return std::find(die.regions.begin(), die.regions.end(), region) != die.regions.end();
    });
  };
  const auto fits = [&](std::size_t region) {
    const double size = square_edge_m(cloud, regions[region]);
    return !of_a_body(region) && size > (1 - size_share) * edges[0] &&
           size < (1 + size_share) * edges[2];
  };
  return std::any_of(search.pairs.begin(), search.pairs.end(), [&](const FacetPair& pair) {
    return looks_like_a_die(pair, regions, edges[2]) && fits(pair.regions[0]) &&
           fits(pair.regions[1]);
  });
}

template <typename T>
void best_first(std::vector<T>& dice) {
  std::stable_sort(dice.begin(), dice.end(),
                   [](const T& a, const T& b) { return a.score < b.score; });
}

}  // namespace

DieSearch search_dice(const Cloud& cloud, const std::vector<PlaneRegion>& regions,
                      const DieFinderOptions& options) {
  DieSearch out;
  const auto edges = sorted_edges(options);
  const double radius = options.near_radius_m > 0 ? options.near_radius_m : 2 * edges[2];
  const auto sized = facet_sized(cloud, regions, options);
  std::vector<DieCandidate> found;
  out.pairs = facet_pairs(regions, sized, edges[2]);
  for (const Triple& triple : corner_triples(regions, sized, options)) {
    const auto facets = fit_facets(
        cloud, {regions[triple[0]], regions[triple[1]], regions[triple[2]]}, options.facets);
    if (!facets) {
      out.rejected.push_back({triple, regions[triple[0]].centroid_m, facets.refusal(), 1e9});
      continue;
    }
    DieCandidate die = describe(cloud, triple, *facets, options);
    if (options.near_m && (die.centre_m - *options.near_m).norm() > radius) continue;
    if (const auto refusal = why_not(die, options))
      out.rejected.push_back({triple, die.centre_m, *refusal, die.score});
    else
      found.push_back(std::move(die));
  }
  best_first(found);
  best_first(out.rejected);
  out.lone_pair = any_lone_pair(cloud, regions, out, edges);
  for (DieCandidate& die : found) {
    const bool again =
        std::any_of(out.accepted.begin(), out.accepted.end(), [&](const DieCandidate& better) {
          return (better.centre_m - die.centre_m).norm() < same_place * edges[0];
        });
    if (!again) out.accepted.push_back(std::move(die));
  }
  return out;
}

double longest_edge_m(const DieFinderOptions& options) {
  return sorted_edges(options)[2];
}

std::vector<double> cube_sizes(const Cloud& cloud, const std::vector<PlaneRegion>& regions) {
  constexpr double alike = 1.25, same = 1.1;
  constexpr std::size_t most = 4;
  std::vector<double> sizes;
  for (const PlaneRegion& region : regions) sizes.push_back(square_edge_m(cloud, region));
  const auto count_like = [&](double size) {
    return std::count_if(sizes.begin(), sizes.end(),
                         [&](double each) { return each < alike * size && size < alike * each; });
  };
  std::vector<std::pair<std::ptrdiff_t, double>> ranked;
  for (const double size : sizes)
    if (const auto count = count_like(size); count >= 3) ranked.emplace_back(-count, size);
  std::sort(ranked.begin(), ranked.end());
  std::vector<double> out;
  for (const auto& [count, size] : ranked) {
    const bool known = std::any_of(out.begin(), out.end(), [&](double each) {
      return each < same * size && size < same * each;
    });
    if (!known && out.size() < most) out.push_back(size);
  }
  return out;
}

double square_edge_m(const Cloud& cloud, const PlaneRegion& region) {
  constexpr double quantile = 0.95, share_of_edge = 0.62;  // of a square's points
  std::vector<double> distances;
  distances.reserve(region.indices.size());
  for (const std::uint32_t i : region.indices)
    distances.push_back((cloud.positions[i] - region.centroid_m).squaredNorm());
  const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(quantile * distances.size());
  if (rank == distances.end()) return 0;
  std::nth_element(distances.begin(), rank, distances.end());
  return std::sqrt(*rank) / share_of_edge;
}

Result<std::vector<DieCandidate>> result_of(DieSearch search, std::size_t planes,
                                            const DieFinderOptions& options) {
  if (!search.accepted.empty()) return std::move(search.accepted);
  // A body of another size beside two facets of the right one is furniture.
  const bool furniture = !search.rejected.empty() && search.lone_pair &&
                         search.rejected.front().refusal.code == RefusalCode::size_mismatch;
  if (!search.rejected.empty() && !furniture) return search.rejected.front().refusal;
  const std::string size = text("%.3f m", longest_edge_m(options));
  if (!search.pairs.empty())
    return Refusal{RefusalCode::too_few_facets,
                   "only two adjacent planes of about " + size +
                       " were found together, a corner needs three; scan from where three facets "
                       "of the die are seen"};
  const std::string none = "none of the " + std::to_string(planes) + " planes found";
  if (options.near_m)
    return Refusal{RefusalCode::no_die, none + " makes a die of " + size +
                                            " near the place that --near names (in the master's "
                                            "frame); check it, or leave it out"};
  return Refusal{RefusalCode::no_die, none + " makes a die of " + size +
                                          "; check --edge, or narrow the search with --near"};
}

Result<std::vector<DieCandidate>> find_dice(const Cloud& cloud,
                                            const std::vector<PlaneRegion>& regions,
                                            const DieFinderOptions& options) {
  return result_of(search_dice(cloud, regions, options), regions.size(), options);
}

}  // namespace alea
