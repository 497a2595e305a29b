#include "alea/markerless/pose_covariance.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace alea {
namespace {

struct Equations {
  Matrix6d normal_matrix = Matrix6d::Zero();
  std::map<std::array<int, 3>, Vector6d> scores;  ///< by block, in a fixed order
};

Equations equations_of(const PreparedScan& fixed, const PreparedScan& moving,
                       const RigidTransform& pose, const Eigen::Vector3d& about_m, double block_m) {
  const double gate_m = 1.2 * std::max(fixed.cell_m, moving.cell_m);
  Equations sums;
  for (std::size_t i = 0; i < moving.fine.size(); ++i) {
    const Eigen::Vector3d p = pose * moving.fine.positions[i];
    const auto near = fixed.fine_index.nearest_one(p, gate_m);
    if (!near) continue;
    const Eigen::Vector3d n = fixed.fine.normals[near->index].cast<double>();
    if (n.dot(pose.rotation * moving.fine.normals[i].cast<double>()) < 0.7) continue;
    const Eigen::Vector3d arm = p - about_m;
    Vector6d row;
    row << arm.cross(n), n;
    sums.normal_matrix += row * row.transpose();
    std::array<int, 3> block{};
    for (int k = 0; k < 3; ++k)
      block[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(p[k] / block_m));
    sums.scores.try_emplace(block, Vector6d::Zero()).first->second +=
        row * n.dot(p - fixed.fine.positions[near->index]);
  }
  return sums;
}

/// Least eigenvalue over the largest, rotations in units of the radius that makes them comparable.
double least_share(const Matrix6d& normal_matrix) {
  const double turns = normal_matrix.topLeftCorner<3, 3>().trace();
  const double shifts = normal_matrix.bottomRightCorner<3, 3>().trace();
  if (!(turns > 0 && shifts > 0)) return 0;
  Vector6d scale;
  scale << Eigen::Vector3d::Constant(1 / std::sqrt(turns)),
      Eigen::Vector3d::Constant(1 / std::sqrt(shifts));
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scale.asDiagonal() * normal_matrix *
                                                       scale.asDiagonal());
  return solver.eigenvalues()[0] / solver.eigenvalues()[5];
}

}  // namespace

std::optional<TransformCovariance> pose_covariance(const PreparedScan& fixed,
                                                   const PreparedScan& moving,
                                                   const RigidTransform& fixed_from_moving,
                                                   const Eigen::Vector3d& about_m, double block_m) {
  const Equations sums = equations_of(fixed, moving, fixed_from_moving, about_m, block_m);
  if (sums.scores.size() < 12 || least_share(sums.normal_matrix) < 1e-5) return std::nullopt;
  Matrix6d spread = Matrix6d::Zero();
  for (const auto& [block, score] : sums.scores) spread += score * score.transpose();
  const auto blocks = static_cast<double>(sums.scores.size());
  const Matrix6d inverse = sums.normal_matrix.inverse();
  const Matrix6d covariance = inverse * spread * inverse * (blocks / (blocks - 6));
  return TransformCovariance{(covariance + covariance.transpose()) / 2, about_m};
}

}  // namespace alea
