#pragma once

#include <string>
#include <utility>
#include <vector>

#include "alea/checkerboard/measurement.hpp"
#include "alea/transform/icp.hpp"

namespace alea {

/// The published pipeline with its steps as switches (Goo, Li, Wicaksono, Boehm, Checkerboard
/// target measurement in unordered point clouds with coloured ICP).
struct ColouredBoardOptions {
  bool remove_outliers = true;  ///< points off the plane that random samples agree on
  bool binarise = true;         ///< intensities to 0 and 1 by Otsu's threshold
  bool point_to_plane = true;   ///< a first alignment without colour
  bool coloured = true;
  bool centred = true;            ///< centred and scaled to the board's side before any ICP
  int template_points = 40;       ///< along the side
  double max_distance_sides = 1;  ///< of a pair
  double crop_sides = 1;          ///< radius of the crop about the place
  double lambda = 0.968;
  int max_iterations = 50;
  std::size_t normal_neighbours = 60;
  /// Pose of the template at the start, scan from board; empty: at the place, facing the scanner,
  /// rows upward.
  std::optional<RigidTransform> start;
};

/// What each step left, for pictures: scan from board after it, and the points that it used.
struct ColouredBoardStages {
  Cloud cropped, without_outliers, binarised;
  std::vector<std::pair<std::string, RigidTransform>> poses;  ///< "start", "point_to_plane", ...
};

/// Crop, removal of outliers, Otsu, point-to-plane ICP, coloured ICP of a template onto the points.
/// Refuses as too_few_points, no_plane, no_pattern (colour score not above one half) or
/// no_convergence; has no covariance. `stages` may be null.
Result<BoardMeasurement> measure_by_coloured_icp(const Cloud& cloud, const Eigen::Vector3d& near_m,
                                                 const BoardOptions& options,
                                                 const ColouredBoardOptions& coloured,
                                                 ColouredBoardStages* stages = nullptr);

}  // namespace alea
