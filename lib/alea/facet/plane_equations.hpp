#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "alea/facet/plane_fit.hpp"

namespace alea {

/// The frame in which a plane is fitted: about the middle of the points' bounding box, which no
/// order of them changes.
struct CentredFrame {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  double reach_m = 0;                      ///< largest coordinate difference from the origin
  std::optional<Eigen::Vector3d> scanner;  ///< in this frame
};

/// Throws Error(usage) for fewer than three points, coinciding or non-finite ones.
CentredFrame centred_frame(std::span<const Eigen::Vector3d> points, const PlaneFitOptions& options);

/// A plane in a centred frame.
struct CentredPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// One point's part in a fit. The minimised residual is the distance along the normal, or along the
/// ray; its derivatives by a, b, c (see PlaneFit::covariance, about CentredPlane::point).
struct PlaneObservation {
  double residual_m = 0;
  double variance_m2 = 0;  ///< of the residual, by the noise model
  double weight = 0;
  double by_a = 0, by_b = 0, by_c = 1;  ///< by_c is 1, or 1 / cos(incidence) along the ray
};

/// Residuals, derivatives and weights at a plane; robust weights included where asked for. Along
/// the ray everything but the residual is taken where the ray meets the plane, not at the measured
/// point.
std::vector<PlaneObservation> observe_plane(std::span<const Eigen::Vector3d> points,
                                            const CentredFrame& frame, const CentredPlane& plane,
                                            const PlaneFitOptions& options);

/// Sums J'WJ, J'We and J'WSWJ (S: the residuals' variances), free of the points' order.
struct PlaneEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
};
PlaneEquations sum_equations(const std::vector<PlaneObservation>& observations);

/// Mean and principal plane of weighted points; an empty span of weights means equal ones. The
/// normal points to the scanner, else to the origin of the points' own frame.
CentredPlane principal_plane(std::span<const Eigen::Vector3d> points, const CentredFrame& frame,
                             std::span<const PlaneObservation> weights);

/// The mean of value(observation), free of order.
double order_free_mean(const std::vector<PlaneObservation>& observations,
                       double (*value)(const PlaneObservation&));

}  // namespace alea
