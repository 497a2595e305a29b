#include "alea/die/facet_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alea {
namespace {

// First look, on the detector's planes: wide enough that a bad die is named, not overlooked.
constexpr double loose_dot = 0.5736;             // sine of 35 deg
constexpr double largest_centre_distance = 1.5;  // of the longest edge; a cube has 0.71
constexpr double right_dot = 0.1736;             // sine of 10 deg
constexpr double near_misfit = 0.12;             // of the edge

}  // namespace

bool may_adjoin(const PlaneRegion& a, const PlaneRegion& b, double longest_edge_m) {
  return std::abs(a.plane.normal.dot(b.plane.normal)) < loose_dot &&
         (a.centroid_m - b.centroid_m).norm() < largest_centre_distance * longest_edge_m;
}

std::vector<FacetPair> facet_pairs(const std::vector<PlaneRegion>& regions,
                                   const std::vector<std::size_t>& sized, double longest_edge_m) {
  std::vector<FacetPair> found;
  for (std::size_t a = 0; a < sized.size(); ++a)
    for (std::size_t b = a + 1; b < sized.size(); ++b) {
      const PlaneRegion &first = regions[sized[a]], &second = regions[sized[b]];
      if (!may_adjoin(first, second, longest_edge_m)) continue;
      const double distance = (first.centroid_m - second.centroid_m).norm();
      found.push_back({{sized[a], sized[b]},
                       (first.centroid_m + second.centroid_m) / 2,
                       std::abs(distance - longest_edge_m / std::numbers::sqrt2)});
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const FacetPair& a, const FacetPair& b) { return a.misfit_m < b.misfit_m; });
  return found;
}

bool looks_like_a_die(const FacetPair& pair, const std::vector<PlaneRegion>& regions,
                      double edge_m) {
  const PlaneRegion &first = regions[pair.regions[0]], &second = regions[pair.regions[1]];
  return std::abs(first.plane.normal.dot(second.plane.normal)) < right_dot &&
         pair.misfit_m < near_misfit * edge_m;
}

}  // namespace alea
