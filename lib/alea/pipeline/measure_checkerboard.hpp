#pragma once

#include <optional>
#include <vector>

#include "alea/checkerboard/coloured_measurement.hpp"
#include "alea/pipeline/registration.hpp"

namespace alea {

enum class BoardMethod { likelihood, coloured_icp };
const char* to_string(BoardMethod method);

struct MeasureCheckerboardOptions {
  BoardOptions target;
  std::optional<Eigen::Vector3d> near_m;  ///< empty: every target of this size in the scan
  BoardMethod method = BoardMethod::likelihood;
  ColouredBoardOptions coloured;
};

/// Scan in, centres of checkerboards out, best first; one where a place is given. Coloured ICP
/// without a place starts from what the likelihood finds. Refuses as the methods do.
Result<std::vector<BoardMeasurement>> measure_checkerboard(
    const Cloud& cloud, const MeasureCheckerboardOptions& options);

struct CheckerboardsRegistered {
  RigidTransform master_from_slave;
  TransformCovariance covariance;
  std::vector<BoardMeasurement> master, slave;             ///< all that were found
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< master, slave
  std::vector<double> residual_m;
};

/// Two scans in, the transform between their frames out: find the targets of each, pair them by
/// their mutual distances, carry one set of centres onto the other with their covariances.
/// Refuses as no_target, too_few_points (fewer than three), collinear, no_match.
Result<CheckerboardsRegistered> register_checkerboards(const Cloud& master, const Cloud& slave,
                                                       const BoardOptions& target);

}  // namespace alea
