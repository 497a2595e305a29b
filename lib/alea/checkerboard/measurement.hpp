#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "alea/checkerboard/board.hpp"
#include "alea/core/cloud.hpp"
#include "alea/core/result.hpp"

namespace alea {

/// Unit vectors along the columns and along the rows, in the scan's frame.
using BoardAxes = Eigen::Matrix<double, 3, 2>;

/// A checkerboard that was measured, in the scan's own frame.
struct BoardMeasurement {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Matrix3d> covariance;  ///< m^2; none from coloured ICP, which has none
  std::optional<Eigen::Matrix3d> bound;       ///< inverse Fisher information, m^2
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< towards the scanner
  BoardAxes axes = BoardAxes::Zero();  ///< [columns rows normal] is right-handed, rows look up
  /// The other axes under which the pattern looks the same.
  std::vector<BoardAxes> alternatives;
  double cell_m = 0;
  bool cell_estimated = false;  ///< else as given: a 2 x 2 board has one edge each way
  double rmse_m = 0;            ///< of the points about the plane, along the normal
  double colour_score = 0;
  double correlation = 0;  ///< of intensities with the pattern
  double dark = 0, light = 0;
  Eigen::Vector2d blur_m = Eigen::Vector2d::Zero();  ///< along columns and rows
  std::size_t points = 0;                            ///< that the fit used
  std::vector<std::string> warnings;                 ///< "code: text"
};

struct BoardOptions {
  BoardSpec board;
  /// In the cloud's frame: which side the normal shows, and the rays of the points. Empty: the
  /// cloud's own, else its origin.
  std::optional<Eigen::Vector3d> scanner_position;
  /// False: points have no rays (a template, a merged cloud); places on the plane are their feet.
  bool along_rays = true;
  double search_sides = 1;  ///< how far the centre may lie from where it is looked for
};

/// The scanner's position by the rule above.
Eigen::Vector3d scanner_of(const Cloud& cloud, const BoardOptions& options);

/// The centre of the board near a place, by the likelihood of intensities on a robust plane:
/// plane along the rays, global search over rotation and shift, fit of blurred edges.
/// Refuses as too_few_points, no_plane, no_pattern, size_mismatch, ambiguous_target or
/// unobservable. Throws Error(usage) for a board out of range, Error(input) for a cloud without
/// intensities. The same bits for any thread count and any order of the points.
Result<BoardMeasurement> measure_by_likelihood(const Cloud& cloud, const Eigen::Vector3d& near_m,
                                               const BoardOptions& options);

}  // namespace alea
