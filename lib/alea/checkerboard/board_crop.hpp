#pragma once

#include "alea/checkerboard/board_plane.hpp"
#include "alea/checkerboard/measurement.hpp"

namespace alea {

/// measure_by_likelihood on points that are cropped already; `facing` is the scanner's place about
/// the points' origin (m), which is where the board is looked for.
Result<BoardMeasurement> measure_points(const BoardPoints& points, const Eigen::Vector3d& facing,
                                        const BoardOptions& options);

}  // namespace alea
