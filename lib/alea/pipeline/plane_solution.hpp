#pragma once

#include <span>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/check_planes.hpp"

namespace alea {

/// The transform under which pairs of planes agree best.
struct PlaneSolution {
  RigidTransform master_from_slave;
  /// Left perturbation about the mean of the planes' centroids, master frame; widened by the
  /// variance factor where that is above one.
  TransformCovariance covariance;
  double variance_factor = 1;  ///< of the misclosures; 1 where none are left over
  int iterations = 0;
};

/// Gauss-Newton over the misclosures of all pairs, two tilts and an offset each, weighted with the
/// covariances of both fits. Refuses as unobservable where the normals do not span space: three
/// planes with independent normals are needed (the sum of n n' over the pairs, per pair, must have
/// its smallest eigenvalue above 0.01, e.g. one wall 10 deg off among three).
Result<PlaneSolution> solve_planes(std::span<const CommonPlane> planes,
                                   const RigidTransform& start);

}  // namespace alea
