#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "alea/core/noise_model.hpp"
#include "alea/core/plane.hpp"

namespace alea {

/// What a plane fit minimises. Points selected by measured coordinates go with `orthogonal`, points
/// selected by the direction of their rays with `along_ray`; the other pairs tilt the plane by
/// sigma_n^2 tan(incidence) / (L^2 / 12), however many points there are (see README.md).
enum class FitMethod {
  orthogonal,  ///< distances along the normal (principal components)
  along_ray,   ///< distances along the scanner's rays, weighted by the noise model
};

struct PlaneFitOptions {
  FitMethod method = FitMethod::along_ray;
  /// Frame of the points (m). Required by `along_ray` and `area_weights`; without it the normal
  /// of an orthogonal fit points to the frame's origin, and the noise model is taken at normal
  /// incidence.
  std::optional<Eigen::Vector3d> scanner_position = Eigen::Vector3d(0, 0, 0);
  NoiseModel noise;
  bool area_weights =
      false;            ///< weigh by the surface that a ray stands for, rho^2 / cos(incidence):
                        ///< a warped facet then has one plane from wherever it is seen
  bool robust = false;  ///< Huber weights (1.345 times the residuals' own scale)
};

/// A plane with its covariance.
struct PlaneFit {
  Plane plane;  ///< the normal points to the scanner's side (outward for a facet)
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< mean of the points, on the plane
  /// Unit vectors e1, e2: [e1 e2 normal] is right-handed.
  Eigen::Matrix<double, 3, 2> tangent = Eigen::Matrix<double, 3, 2>::Zero();
  /// Order a (rad), b (rad), c (m): normal' = normal + a e1 + b e2 turned about centroid_m, then
  /// the plane shifted by c along the normal. Already scaled by `variance_factor`.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double rmse_m = 0;           ///< root mean square distance along the normal
  double variance_factor = 1;  ///< squared residuals over what the noise model expects
  std::size_t points = 0;
};

/// Fits a plane to points (m). Orthogonal: principal components about the mean. Along the ray:
/// minimises sum (rho - rho_plane)^2 / s_rho^2 over the measured ranges rho, with s_rho from the
/// noise model at the predicted range and incidence; to first order the linear problem
/// sum rho^4 / s_rho^2 (1/rho - m.u)^2 with m = n / d, solved by Gauss-Newton steps with the
/// Jacobian at the predicted point, so that noise in the weights does not bias the plane.
/// The result has the same bits for any order of the points, and moves with them: cloud and scanner
/// 5e5 m away give the same plane to 1e-9 rad and 1e-7 m.
/// Throws Error(usage) for fewer than three points, points on one line, or a missing scanner
/// position.
PlaneFit fit_plane(std::span<const Eigen::Vector3d> points, const PlaneFitOptions& options);

/// The same from a plane that is nearly right, which saves passes.
PlaneFit fit_plane(std::span<const Eigen::Vector3d> points, const Plane& start,
                   const PlaneFitOptions& options);

/// One pass of the same fit from a plane that is nearly right: what an iteration that selects
/// points again after each pass needs.
Plane improve_plane(std::span<const Eigen::Vector3d> points, const Plane& start,
                    const PlaneFitOptions& options);

/// Root mean square distance (m) of points from their own orthogonal fit, without the rest of it.
double orthogonal_rmse_m(std::span<const Eigen::Vector3d> points);

/// The same plane with its normal to the other side; tangent and covariance follow.
PlaneFit flipped(const PlaneFit& fit);

}  // namespace alea
