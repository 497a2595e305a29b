#pragma once

#include "alea/markerless/pose_candidate.hpp"
#include "alea/markerless/prepared_scan.hpp"

namespace alea {

struct YawSweepOptions {
  double yaw_step_rad = 0.0524;  ///< 3 deg
  int shifts_per_yaw = 16;
  std::size_t axes = 3;       ///< of symmetry, of each scan
  double height_range_m = 4;  ///< largest difference of the scanners' heights
};

/// Poses of two upright scans: for each yaw, the shifts at which their vertical surfaces lie on
/// each other facing the same way (wall_correlation.hpp). Heights by a vote of the horizontal
/// surfaces. Scores: correlation as a share of the largest possible.
std::vector<PoseCandidate> yaw_sweep(const PreparedScan& fixed, const PreparedScan& moving,
                                     const YawSweepOptions& options);

/// Poses that bring an axis of symmetry of one scan onto one of the other (symmetry_axis.hpp), for
/// each yaw: also those at which the scans show opposite sides of a building and no wall lies on
/// another. Scores: the product of the axes' own.
std::vector<PoseCandidate> axis_sweep(const PreparedScan& fixed, const PreparedScan& moving,
                                      const YawSweepOptions& options);

}  // namespace alea
