#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "alea/core/noise_model.hpp"
#include "alea/core/result.hpp"

namespace alea {

/// What a sphere fit minimises.
enum class SphereFitMethod {
  along_ray,  ///< (measured - predicted range) over its standard deviation
  geometric   ///< distances from the surface, equal weights; biased by noise along grazing rays
};

struct SphereFitOptions {
  SphereFitMethod method = SphereFitMethod::along_ray;
  double radius_m = 0.0725;  ///< its value, or where the search begins
  bool radius_known = true;
  Eigen::Vector3d scanner_position = Eigen::Vector3d::Zero();  ///< frame of the points (m)
  NoiseModel noise;
  /// Rays that would meet the sphere more obliquely are left out (a footprint mixes there).
  double max_incidence_rad = 1.3962634015954636;  // 80 deg
  double gate_sd = 4;  ///< residuals beyond this many standard deviations are left out
  std::size_t min_points = 20;
};

/// A fitted sphere, in the frame of the points.
struct SphereFit {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the centre (m^2), scaled by the
                                                         ///< variance factor
  double radius_sd_m = 0;                                ///< 0 where the radius is known
  double rmse_m = 0;                                     ///< along the sphere's normal
  double variance_factor = 1;  ///< squared residuals over what the noise model expects
  std::size_t points = 0;      ///< that took part
};

/// Least-squares sphere from a start within about a third of the radius. Along the ray: the range
/// predicted for the ray u of a point, from the scanner, is rho = u.c - sqrt(R^2 - |u x c|^2), with
/// Jacobian -(n, 1)/cos(incidence) at the predicted point; membership depends on the ray alone, up
/// to a gate on the residual, so that no noise selects its own points (cf. Franaszek, Cheok,
/// Witzgall 2009, on fits along the beam).
/// The same bits for any order of the points. Refuses as too_few_points or no_convergence; throws
/// a usage error for a radius that is not positive.
Result<SphereFit> fit_sphere(std::span<const Eigen::Vector3d> points,
                             const Eigen::Vector3d& start_centre_m,
                             const SphereFitOptions& options);

}  // namespace alea
