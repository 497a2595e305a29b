#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"

namespace alea {

/// One pair of a network: where scan `b` stands in the frame of scan `a`.
struct PoseEdge {
  std::size_t a = 0, b = 0;
  RigidTransform a_from_b;
  /// Of the left perturbation in a's frame about a's origin (rad, m).
  Matrix6d covariance = Matrix6d::Identity();
};

struct PoseGraphOptions {
  /// A loop of edges closes when its misclosure is below this quantile of chi-square with 6 degrees
  /// of freedom (0.999), its covariance grown by `closure_floor`.
  double largest_closure = 22.458;
  double rotation_floor_rad = 0.0004;  ///< of an edge beyond its covariance, 1 sigma: 0.02 deg
  double translation_floor_m = 0.004;
  int max_iterations = 60;
};

/// A network of `stations` scans in the frame of the first.
struct PoseGraph {
  std::vector<RigidTransform> network_from_scan;
  std::vector<Matrix6d> covariance;   ///< left perturbation in the network frame, about the station
  std::vector<std::size_t> rejected;  ///< edges that do not close, ascending
  double chi_square = 0;              ///< of the accepted edges, weighted by the grown covariances
  int iterations = 0;
};

/// Poses of all stations from pairwise ones. Edges that contradict the loops they take part in are
/// rejected: a spanning tree grows by the edges that close the most triangles and short loops, and
/// what does not close against it goes. The rest is adjusted by Levenberg-Marquardt with a Cauchy
/// loss (Ceres); covariances from the inverse normal matrix. One thread; the same bits on every
/// run. Refuses (no_match) where the accepted edges leave a station unconnected. Throws
/// Error(usage) for an edge without two different stations in range.
Result<PoseGraph> solve_pose_graph(std::size_t stations, const std::vector<PoseEdge>& edges,
                                   const PoseGraphOptions& options = {});

}  // namespace alea
