#pragma once

#include <Eigen/Core>
#include <vector>

#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/check_planes.hpp"

namespace alea {

/// A check plane of a finished registration against what the plan foretold there.
struct PlanCheck {
  int id = 0;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< master frame
  double offset_m = 0;  ///< measured: slave minus master along the normal, at the centroid
  /// Predicted standard deviation of that offset: the transform's along the normal, and the two
  /// planes' own, as far as their points scatter at random.
  double predicted_sd_m = 0;
};

/// One entry for each check plane with the role `check`, in their order. `predicted` is the
/// covariance of master_from_slave in the master's frame.
std::vector<PlanCheck> check_plan(const TransformCovariance& predicted,
                                  const std::vector<CheckPlane>& planes);

}  // namespace alea
