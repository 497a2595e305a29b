#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace alea {

struct DbscanOptions {
  double radius = 1;           ///< neighbourhood, in the points' unit, its rim included
  std::size_t min_points = 4;  ///< in the neighbourhood of a core point, itself included
};

/// Density-based clusters: Ester, Kriegel, Sander, Xu 1996, A density-based algorithm for
/// discovering clusters in large spatial databases with noise (KDD-96). One label a point, 0, 1,
/// ... in the order of each cluster's first core point; -1 is noise. A border point that two
/// clusters reach goes to the earlier one. Throws Error(usage) for a radius that is not positive.
std::vector<int> dbscan(std::span<const Eigen::Vector2d> points, const DbscanOptions& options);

}  // namespace alea
