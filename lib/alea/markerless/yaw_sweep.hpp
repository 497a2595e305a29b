#pragma once

#include "alea/markerless/pose_candidate.hpp"
#include "alea/markerless/prepared_scan.hpp"

namespace alea {

struct YawSweepOptions {
  double yaw_step_rad = 0.0698;  ///< 4 deg
  double cell_m = 0.4;           ///< of the images seen from above; widened for wide scans
  int image_cells = 128;         ///< a side, a power of two; 256 for wide scans
  int peaks_per_yaw = 3;
  double height_range_m = 4;  ///< largest difference of the scanners' heights
};

/// Poses of two upright scans: for each yaw, the shifts at which their vertical surfaces lie on
/// each other facing the same way, by correlation of two images seen from above; a cell of an image
/// holds the sum of the horizontal normals in it as a complex number, so that opposite faces of a
/// wall repel. Heights by a vote of the horizontal surfaces. Every turn of a symmetric building
/// comes out as a candidate: it is the search about the axis of symmetry, for any axis. Scores:
/// correlation as a share of the largest possible.
std::vector<PoseCandidate> yaw_sweep(const PreparedScan& fixed, const PreparedScan& moving,
                                     const YawSweepOptions& options);

}  // namespace alea
