#pragma once

#include <Eigen/Core>
#include <span>

#include "alea/core/rigid_transform.hpp"

namespace alea::experiments::die {

/// Count, mean and second moments of points on a plane: enough for the RMSE of any orthogonal fit
/// to them, in any frame and together with others, without touching the points again.
struct PlaneMoments {
  double count = 0;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();  ///< sum of squares about the mean
};

PlaneMoments plane_moments(std::span<const Eigen::Vector3d> points);

/// The moments of the transformed points.
PlaneMoments moved(const PlaneMoments& moments, const RigidTransform& to_from);

/// The moments of both sets together.
PlaneMoments joined(const PlaneMoments& a, const PlaneMoments& b);

/// RMSE (m) of the orthogonal fit to the points.
double fit_rmse_m(const PlaneMoments& moments);

/// Unit normal of that fit, either way round.
Eigen::Vector3d fit_normal(const PlaneMoments& moments);

}  // namespace alea::experiments::die
