#pragma once

#include <optional>

#include "alea/markerless/prepared_scan.hpp"

namespace alea {

/// Covariance of a refined pose, of the left perturbation in the fixed scan's local frame about
/// `about_m` there: H^-1 (sum over blocks of g g') H^-1, H the information matrix of the
/// point-to-plane pairs and g the score of the pairs in one block of `block_m`. Residuals of one
/// surface share their errors (sampling, curvature, calibration), so blocks count as observations
/// and not points (Liang, Zeger 1986, doi 10.1093/biomet/73.1.13). Empty where a direction of
/// motion is not determined or fewer than 12 blocks hold pairs.
std::optional<TransformCovariance> pose_covariance(const PreparedScan& fixed,
                                                   const PreparedScan& moving,
                                                   const RigidTransform& fixed_from_moving,
                                                   const Eigen::Vector3d& about_m,
                                                   double block_m = 1.5);

}  // namespace alea
