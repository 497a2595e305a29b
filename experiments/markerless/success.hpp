#pragma once

#include <string>
#include <vector>

#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/robust_study.hpp"

namespace alea::experiments::markerless {

/// One pose of one pair with everything that could tell whether it is true.
struct JudgedPose {
  std::string building, fixed, moving;
  std::string source;  ///< paper, robust, or alternative
  std::string pair;    ///< the same for a pair and its reverse
  PoseError error;
  double rmse_m = 0;             ///< of all nearest neighbours
  double overlap = 0;            ///< share of the points that agree
  double least_information = 0;  ///< smallest eigenvalue of the information over the largest
  double tilt_deg = 0;           ///< of the vertical between the levelled scans
  double closure_m = 0;          ///< see closure_m()
  double conflict_ratio = 0;     ///< free-space violations over agreements
  /// Conflict ratio of the best other pose less its own, in [-1, 1]; 1 where there is no other.
  double margin = 0;
};

/// What a pose times that of the pair in reverse moves at 5 m, metres: 0 where the two agree.
double closure_m(const RigidTransform& fixed_from_moving, const RigidTransform& moving_from_fixed);

/// Every pose that either method considered for a pair. A pose closes with the pose that the same
/// method found in reverse; the other poses of its margin are those of the robust search, 2 deg or
/// 0.3 m away. Pairs whose reverse is not among the trials are left out.
std::vector<JudgedPose> judged_poses(const std::string& building, const TwinScans& scans,
                                     const std::vector<PreparedScan>& prepared,
                                     const std::vector<RobustTrial>& robust,
                                     const std::vector<PaperTrial>& paper);

/// One figure of a pose: what it is called and where less of it speaks for the pose.
struct PoseFigure {
  const char* name;
  double sign;  ///< so that less is better
  double JudgedPose::*value;
};
const std::vector<PoseFigure>& pose_figures();

/// Area under the receiver operating characteristic: the chance that a true pose scores lower than
/// a false one, 0.5 where it tells nothing. Its 95 % interval draws whole pairs again (1,000 times,
/// keyed by `seed`), because the poses of one pair depend on each other.
Interval area_under_roc(const std::vector<JudgedPose>& poses, const PoseFigure& figure,
                        std::uint64_t seed);

/// How well each figure tells true poses from false ones.
ResultTable success_table(const std::vector<JudgedPose>& poses, std::uint64_t seed);

/// The poses one by one.
std::string poses_csv(const std::vector<JudgedPose>& poses);

/// True poses kept against false poses let through, a line for each figure: FOLDER/NAME.png.
void draw_roc(const std::vector<JudgedPose>& poses, const std::string& folder,
              const std::string& name);

}  // namespace alea::experiments::markerless
