#include "alea/die/plane_match.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"

namespace alea {

PlaneMatch match_planes(const PlaneFit& target, const PlaneFit& source,
                        const RigidTransform& target_from_source) {
  const Eigen::Vector3d normal = target_from_source.rotation * source.plane.normal;
  const Eigen::Matrix<double, 3, 2> tangent = target_from_source.rotation * source.tangent;
  const Eigen::Vector3d at = target.centroid_m;
  const Eigen::Vector3d lever = target_from_source * source.centroid_m - at;
  PlaneMatch match;
  match.residual << target.tangent.transpose() * normal, normal.dot(lever);
  match.by_transform.setZero();
  match.by_source.setZero();
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d e = target.tangent.col(k);
    match.by_transform.row(k).head<3>() = normal.cross(e);
    match.by_source.row(k).head<2>() = e.transpose() * tangent;
  }
  match.by_transform.row(2) << at.cross(normal).transpose(), normal.transpose();
  match.by_source.row(2) << lever.transpose() * tangent, 1;
  return match;
}

PlaneFit recentred(const PlaneFit& fit, const Eigen::Vector3d& origin_m) {
  PlaneFit moved = fit;
  moved.centroid_m -= origin_m;
  moved.plane.offset_m = moved.plane.normal.dot(moved.centroid_m);
  return moved;
}

LeastSquares solve_misclosures(const Misclosures& m) {
  const bool exact = m.covariance.isZero(0);
  const Eigen::Index rows = m.value.size(), unknowns = m.by_unknowns.cols();
  const Eigen::MatrixXd covariance =
      exact ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(rows, rows)) : m.covariance;
  // Scaled to unit diagonal: tilts and offsets differ by orders of magnitude.
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> root(scale.asDiagonal() * covariance * scale.asDiagonal());
  if (root.info() != Eigen::Success)
    throw usage_error("least squares: the covariance of the misclosures is not positive definite");
  const Eigen::MatrixXd a = root.matrixL().solve(scale.asDiagonal() * m.by_unknowns);
  const Eigen::VectorXd w = root.matrixL().solve(scale.asDiagonal() * m.value);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  if (qr.rank() < unknowns)
    throw usage_error("least squares: the misclosures do not determine the unknowns");
  LeastSquares solution;
  solution.correction = -qr.solve(w);
  solution.covariance = Eigen::MatrixXd::Zero(unknowns, unknowns);
  if (exact) return solution;
  const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd::Identity(rows, rows));
  solution.covariance = inverse * inverse.transpose();
  solution.chi_square = (w + a * solution.correction).squaredNorm();
  return solution;
}

}  // namespace alea
