#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "alea/sphere/surface_cells.hpp"

namespace alea {

/// A place where many pieces of surface agree that the centre of a sphere lies.
struct CentreCandidate {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  int votes = 0;  ///< pieces of surface, one for each cell
};

/// Each occupied cell fits a plane to its 27-cell window and votes for the point one radius behind
/// it, seen from the scanner (a Hough transform with known radius). Cells, not points, vote, so
/// that near and far spheres count alike: a visible half sphere gives 2 pi (radius / cell)^2 votes
/// to one place, a plane (radius / cell)^2. Candidates with at least `min_votes`, most votes first.
std::vector<CentreCandidate> vote_for_centres(const SurfaceCells& cells,
                                              std::span<const Eigen::Vector3d> points,
                                              const Eigen::Vector3d& scanner_position_m,
                                              double radius_m, int min_votes);

}  // namespace alea
