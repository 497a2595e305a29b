#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

struct NormalOptions {
  int neighbours = 16;  ///< points that a normal is fitted to, its own included; at least 3
  /// Normals point to the side of this place (m); empty: the scanner's position, else the origin.
  std::optional<Eigen::Vector3d> toward;
};

/// One unit normal for each point: the direction of least spread of its nearest neighbours (Hoppe
/// et al. 1992, Surface reconstruction from unorganized points, SIGGRAPH '92). Parallel; the same
/// bits for any thread count and any order of the points. Where the neighbours leave the direction
/// open (fewer than three points, all on one line) it is still a unit vector that says nothing.
/// Throws Error(usage) for fewer than three neighbours.
std::vector<Eigen::Vector3d> estimate_normals(const Cloud& cloud, const NormalOptions& options);

}  // namespace alea
