#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>

namespace alea {

/// Does a facet, or a plane of the scene, belong? Its observation against the same adjustment
/// without it (data snooping, Baarda 1968): the reduction of the sum of squares, chi-square with
/// `freedom`.
struct FacetTest {
  std::size_t scan = 0;  ///< in the order given; the master is 0
  int pips = 0;          ///< of a facet; 0 for a plane of the scene
  int plane = 0;         ///< id of that plane
  /// Observed minus adjusted: two tilts (rad) about the adjusted facet's tangent vectors, offset at
  /// its centre (m).
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Eigen::Vector3d standardised = Eigen::Vector3d::Zero();  ///< zero where nothing checks it
  double statistic = 0;
  int freedom = 0;  ///< 0: nothing checks this facet
  double p_value = 1;
  bool suspect = false;  ///< the strangest of all, and too strange for chance
};

/// Squared residuals of a group over what was assumed; 1 where the assumption holds.
struct VarianceComponent {
  std::string group;                ///< "points", "facets", "scene planes", ...
  std::optional<std::size_t> scan;  ///< of the points: in the order given
  double factor = 1;
  double freedom = 0;  ///< redundancy of the group; its factor has a standard deviation of
                       ///< sqrt(2 / freedom)
};

}  // namespace alea
