#pragma once

#include <Eigen/Core>
#include <span>

#include "alea/core/cloud.hpp"
#include "alea/core/result.hpp"
#include "alea/evaluate/check_planes.hpp"
#include "alea/pipeline/registration.hpp"

namespace alea {

/// What follows a registration by a target, if anything.
enum class Refinement {
  none,
  planes,  ///< the planes that both scans see, see solve_planes
  icp,     ///< point-to-plane ICP on the points of these planes
};

struct RefinedTransform {
  RigidTransform master_from_slave;
  TransformCovariance covariance;  ///< left perturbation, master frame
  RefinementReport report;
};

/// Fine registration on planes that are given (the calibration planes: check planes must not be
/// among them), from a transform that is nearly right. The change is reported at `about_m` (master
/// frame). Refuses as unobservable where the planes do not determine all six parameters, as
/// no_convergence where ICP does not settle. Throws Error(usage) for Refinement::none.
Result<RefinedTransform> refine_registration(Refinement refinement, const Cloud& master,
                                             const Cloud& slave,
                                             std::span<const CommonPlane> planes,
                                             const RigidTransform& start,
                                             const Eigen::Vector3d& about_m);

/// "none", "planes", "icp".
const char* to_string(Refinement refinement);

}  // namespace alea
