#pragma once

#include <array>
#include <optional>
#include <vector>

#include "alea/pipeline/observe_die.hpp"

namespace alea {

/// One of the 24 ways in which the slave's die can lie to the master's, if it is a cube.
struct DieOrientation {
  /// The likeliest readings that say so, of the facets in the order of the scans' candidates.
  std::array<int, 3> master_pips{}, slave_pips{};
  double margin = 0;         ///< log-likelihood of the best pair of readings over this one
  double needed_margin = 0;  ///< the orientation is supported while its margin is below this, or 0
  /// Roughly: a perfect cube behind the facets' normals and the corners.
  RigidTransform master_from_slave;
  /// Points on planes that both scans see under it, where the scene was asked.
  std::optional<double> scene_points;
};

/// Two scans are level to each other if their vertical axes differ by less (rad).
inline constexpr double levelled_within_rad = 0.17;

/// The orientations that the readings of both scans considered, the likeliest first; equals in a
/// fixed order. With `levelled` only those that keep the vertical (levelled_within_rad): 4 of a
/// standing die.
std::vector<DieOrientation> die_orientations(const DieSighting& master, const DieSighting& slave,
                                             bool levelled);

/// The number of the first orientations, up to the last whose margin lies within what its readings
/// need.
std::size_t supported_orientations(const std::vector<DieOrientation>& orientations);

/// The same facets with other pips, in the order of the candidate.
DieSighting relabelled(const DieSighting& sighting, const std::array<int, 3>& pips);

}  // namespace alea
