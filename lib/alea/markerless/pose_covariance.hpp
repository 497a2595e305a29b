#pragma once

#include <optional>

#include "alea/markerless/prepared_scan.hpp"

namespace alea {

/// Covariance of a refined pose, of the left perturbation in the fixed scan's local frame about
/// `about_m` there: H^-1 (sum g g' + s^2 sum r r') H^-1. H is the information matrix of the
/// point-to-plane pairs under Tukey's weights, g the sum of the scores and r that of the rows over
/// one surface (a block of `block_m` and a direction of the normals), s^2 the variance of a
/// residual. The first term counts surfaces as observations and not points (Liang, Zeger 1986, doi
/// 10.1093/biomet/73.1.13); the second lets each surface have an error of its own as large as a
/// residual, which a fit that follows it would hide (sampling, curvature, normals). Empty where a
/// direction of motion is not determined or fewer than 12 surfaces hold pairs.
std::optional<TransformCovariance> pose_covariance(const PreparedScan& fixed,
                                                   const PreparedScan& moving,
                                                   const RigidTransform& fixed_from_moving,
                                                   const Eigen::Vector3d& about_m,
                                                   double block_m = 1);

}  // namespace alea
