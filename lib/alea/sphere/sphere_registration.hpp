#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/sphere/sphere_fit.hpp"

namespace alea {

/// Positions of one sphere in the two lists.
struct SpherePair {
  std::uint32_t master = 0, slave = 0;
};

struct SphereRegistration {
  RigidTransform master_from_slave;
  /// About the master's origin, or about the mean of the centres where that is further than 1 km.
  TransformCovariance covariance;
  std::vector<SpherePair> pairs;
  std::vector<double> residual_m;  ///< distance left between the centres of each pair
  double chi_squared = 0;          ///< of the residuals under the covariances of the centres
};

/// Transform that carries the slave's centres onto the master's, for given pairs: Horn's closed
/// form with weights, then Gauss-Newton steps with the full covariances of both centres, whose
/// normal matrix gives the covariance. Refuses as too_few_points for fewer than three pairs, as
/// collinear where the centres spread less across their line than 1 % of their extent along it or
/// 20 standard deviations of a centre.
Result<SphereRegistration> register_sphere_pairs(std::span<const SphereFit> master,
                                                 std::span<const SphereFit> slave,
                                                 const std::vector<SpherePair>& pairs);

}  // namespace alea
