#pragma once

#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/noise_model.hpp"
#include "alea/core/result.hpp"
#include "alea/sphere/sphere_finder.hpp"
#include "alea/sphere/sphere_match.hpp"

namespace alea {

struct RegisterSpheresOptions {
  double radius_m = 0.0725;
  bool radius_known = true;  ///< false: each sphere's radius is estimated with its centre
  NoiseModel noise;
  SphereFitMethod method = SphereFitMethod::along_ray;
  std::optional<Eigen::Vector3d> master_origin_m;  ///< scanner position; empty: as the cloud says
  std::optional<Eigen::Vector3d> slave_origin_m;
  SphereMatchOptions match;
};

struct SpheresRegistered {
  SphereRegistration registration;
  std::vector<SphereTarget> master, slave;  ///< all spheres that were found
};

/// Two scans in, the transform between their frames out: find the spheres of each, pair them by
/// their mutual distances, carry one set of centres onto the other.
/// Refuses as no_target, too_few_points, collinear or no_match.
Result<SpheresRegistered> register_spheres(const Cloud& master, const Cloud& slave,
                                           const RegisterSpheresOptions& options);

}  // namespace alea
