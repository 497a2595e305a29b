#include "experiments/die/plane_moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace alea::experiments::die {

PlaneMoments plane_moments(std::span<const Eigen::Vector3d> points) {
  PlaneMoments moments;
  moments.count = static_cast<double>(points.size());
  for (const Eigen::Vector3d& p : points) moments.mean_m += p;
  moments.mean_m /= std::max(1.0, moments.count);
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d d = p - moments.mean_m;
    moments.scatter_m2 += d * d.transpose();
  }
  return moments;
}

PlaneMoments moved(const PlaneMoments& moments, const RigidTransform& to_from) {
  return {moments.count, to_from * moments.mean_m,
          to_from.rotation * moments.scatter_m2 * to_from.rotation.transpose()};
}

PlaneMoments joined(const PlaneMoments& a, const PlaneMoments& b) {
  const double count = a.count + b.count;
  const Eigen::Vector3d apart = b.mean_m - a.mean_m;
  return {count, a.mean_m + apart * (b.count / count),
          a.scatter_m2 + b.scatter_m2 + apart * apart.transpose() * (a.count * b.count / count)};
}

double fit_rmse_m(const PlaneMoments& moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.scatter_m2,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]) / moments.count);
}

Eigen::Vector3d fit_normal(const PlaneMoments& moments) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments.scatter_m2).eigenvectors().col(0);
}

}  // namespace alea::experiments::die
