#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/result.hpp"
#include "alea/die/facet_pairs.hpp"
#include "alea/facet/facet_fit.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

struct DieFinderOptions {
  double edge_m = 0.5;  ///< expected length from corner to corner
  /// Of a cuboid, in any order, instead of edge_m.
  std::optional<std::array<double, 3>> edges_m;
  std::optional<Eigen::Vector3d> near_m;  ///< the die's centre lies within near_radius_m of it
  double near_radius_m = 0;               ///< 0: twice the longest expected edge
  /// Share of the smaller of both, the expected edge and that of the extents, beyond their sd.
  double max_size_error = 0.15;
  double max_dihedral_error_rad = 0.3490658503988659;  ///< 20 deg from a right angle
  double min_coverage = 0.6;  ///< share of each facet's area that must carry points
  FacetFitOptions facets;     ///< scanner position, noise and how the facets are fitted
};

/// Three facets about one convex corner, of the right size.
struct DieCandidate {
  std::array<std::size_t, 3> regions{};  ///< into the plane regions given, ascending
  FacetFits facets;                      ///< in the order of `regions`
  std::array<double, 3> dihedral_rad{};  ///< inside the die, along facets.corner.edges[k]
  std::array<double, 3> size_error{};    ///< edge over the expected edge that fits best, minus 1
  std::array<double, 3> coverage{};      ///< share of each facet's area that carries points
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double score = 0;  ///< sum of squared deviations from the die looked for; smaller is better
};

/// Three planes that nearly made a die, and why they did not.
struct RejectedDie {
  std::array<std::size_t, 3> regions{};
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Refusal refusal;
  double score = 0;
};

struct DieSearch {
  std::vector<DieCandidate> accepted;  ///< best first
  std::vector<RejectedDie> rejected;   ///< nearest miss first
  /// Near-orthogonal, close planes of about the right size, the pair whose distance suits the die
  /// best first: a die of which a third facet is missing shows as one.
  std::vector<FacetPair> pairs;
  bool lone_pair = false;  ///< one of them is no part of a rejected body and looks like a die
};

/// The published rule (planes below a size, pairwise dot products near zero, centres close), then
/// what makes it hold in a furnished room: the corner is convex and faces the scanner (decided by
/// exact predicates), the facets are fitted from their own points, reach from the corner to the
/// expected edge, are covered by points, and meet at 90 +- 20 deg.
DieSearch search_dice(const Cloud& cloud, const std::vector<PlaneRegion>& regions,
                      const DieFinderOptions& options);

/// The longest edge that is expected (m).
double longest_edge_m(const DieFinderOptions& options);

/// Edges of the cubes that may be among the planes (m): sizes that three of them have to within a
/// quarter, that of most planes first, four at most.
std::vector<double> cube_sizes(const Cloud& cloud, const std::vector<PlaneRegion>& regions);

/// Edge of a square whose points reach as far from their centroid as this region's (m).
double square_edge_m(const Cloud& cloud, const PlaneRegion& region);

/// What a search over so many planes comes to: its accepted candidates, or why there are none.
Result<std::vector<DieCandidate>> result_of(DieSearch search, std::size_t planes,
                                            const DieFinderOptions& options);

/// The accepted candidates, best first: two like dice are two candidates. Refusals of the nearest
/// miss: no_die, too_few_facets (two facets of a die at most), dihedral, size_mismatch,
/// too_few_points. Throws Error(usage) for an edge that is not positive.
Result<std::vector<DieCandidate>> find_dice(const Cloud& cloud,
                                            const std::vector<PlaneRegion>& regions,
                                            const DieFinderOptions& options);

}  // namespace alea
