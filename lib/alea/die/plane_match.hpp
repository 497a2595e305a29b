#pragma once

#include "alea/core/rigid_transform.hpp"
#include "alea/facet/plane_fit.hpp"

namespace alea {

/// A plane held against the same plane seen in another frame: two tilts about the target's tangent
/// vectors (rad) and the offset at the target's centroid (m), source minus target, with first
/// derivatives.
struct PlaneMatch {
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, 6> by_transform;  ///< left perturbation about the target frame's origin
  Eigen::Matrix3d by_source;                 ///< a, b, c of the source; of the target: minus one
};

PlaneMatch match_planes(const PlaneFit& target, const PlaneFit& source,
                        const RigidTransform& target_from_source);

/// The same fit in a frame whose origin is `origin_m`: near it, so that no digits are lost far off.
PlaneFit recentred(const PlaneFit& fit, const Eigen::Vector3d& origin_m);

/// Linear misclosures w + A x + v = 0 with cov(v) = `covariance`.
struct Misclosures {
  Eigen::VectorXd value;
  Eigen::MatrixXd by_unknowns;
  Eigen::MatrixXd covariance;
};

struct LeastSquares {
  Eigen::VectorXd correction;  ///< x
  Eigen::MatrixXd covariance;  ///< of x
  double chi_square = 0;       ///< v' cov(v)^-1 v, with as many degrees of freedom as there are
                               ///< misclosures beyond unknowns
};

/// Generalised least squares. A covariance of zero (exact data) means equal weights and gives a
/// covariance of zero. Throws Error(usage) where the misclosures do not determine the unknowns.
LeastSquares solve_misclosures(const Misclosures& misclosures);

}  // namespace alea
