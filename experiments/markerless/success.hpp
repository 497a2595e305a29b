#pragma once

#include <string>
#include <vector>

#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// One pose of one pair with everything that could tell whether it is true.
struct JudgedPose {
  bool right = false;
  double rmse_m = 0;             ///< of all nearest neighbours
  double overlap = 0;            ///< share of the points that agree
  double tilt_deg = 0;           ///< of the vertical between the levelled scans
  double conflict_ratio = 0;     ///< free-space violations over agreements
  double least_information = 0;  ///< smallest eigenvalue of the information over the largest
};

/// Every pose that either method considered for a pair.
std::vector<JudgedPose> judged_poses(const PreparedScan& fixed, const PreparedScan& moving,
                                     const std::vector<RigidTransform>& poses,
                                     const RigidTransform& truth);

/// Area under the receiver operating characteristic: the chance that a true pose scores lower than
/// a false one (Hanley, McNeil 1982, doi 10.1148/radiology.143.1.7063747), with their 95 %
/// interval.
Interval area_under_roc(const std::vector<double>& right, const std::vector<double>& wrong);

/// How well each figure tells true poses from false ones.
ResultTable success_table(const std::vector<JudgedPose>& poses);

}  // namespace alea::experiments::markerless
