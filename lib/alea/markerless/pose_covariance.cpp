#include "alea/markerless/pose_covariance.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace alea {
namespace {

/// A block of space and the nearest of the six directions of an axis: points there share a surface.
using Surface = std::array<int, 4>;

struct Pair {
  Vector6d row;
  double residual_m = 0;
  Surface surface{};
};

/// Sums over the pairs of one surface.
struct SurfaceSums {
  Vector6d score = Vector6d::Zero();  ///< of weight, row and residual
  Vector6d row = Vector6d::Zero();    ///< of weight and row
};

struct Equations {
  Matrix6d normal_matrix = Matrix6d::Zero();
  std::map<Surface, SurfaceSums> surfaces;  ///< in a fixed order
  double variance_m2 = 0;                   ///< of a residual
};

Surface surface_of(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, double block_m) {
  Surface surface{};
  for (int k = 0; k < 3; ++k)
    surface[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(p[k] / block_m));
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  surface[3] = 2 * static_cast<int>(axis) + (normal[axis] > 0 ? 1 : 0);
  return surface;
}

std::vector<Pair> pairs_of(const PreparedScan& fixed, const PreparedScan& moving,
                           const RigidTransform& pose, const Eigen::Vector3d& about_m,
                           double block_m) {
  const double gate_m = 1.2 * std::max(fixed.cell_m, moving.cell_m);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < moving.fine.size(); ++i) {
    const Eigen::Vector3d p = pose * moving.fine.positions[i];
    const auto near = fixed.fine_index.nearest_one(p, gate_m);
    if (!near) continue;
    const Eigen::Vector3d n = fixed.fine.normals[near->index].cast<double>();
    if (n.dot(pose.rotation * moving.fine.normals[i].cast<double>()) < 0.7) continue;
    Pair pair;
    pair.row << (p - about_m).cross(n), n;
    pair.residual_m = n.dot(p - fixed.fine.positions[near->index]);
    pair.surface = surface_of(p, n, block_m);
    pairs.push_back(pair);
  }
  return pairs;
}

/// Where Tukey's weights end: 4.685 standard deviations, from the median absolute residual.
double tukey_end_m(const std::vector<Pair>& pairs) {
  std::vector<double> sizes;
  sizes.reserve(pairs.size());
  for (const Pair& pair : pairs) sizes.push_back(std::abs(pair.residual_m));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 4.685 * 1.4826 * *middle;
}

Equations equations_of(const std::vector<Pair>& pairs) {
  Equations sums;
  if (pairs.empty()) return sums;
  const double end_m = tukey_end_m(pairs);
  double weights = 0, squares = 0;
  for (const Pair& pair : pairs) {
    const double u = pair.residual_m / end_m;
    if (!(u * u < 1)) continue;
    const double weight = (1 - u * u) * (1 - u * u);
    sums.normal_matrix += weight * pair.row * pair.row.transpose();
    SurfaceSums& surface = sums.surfaces[pair.surface];
    surface.score += weight * pair.residual_m * pair.row;
    surface.row += weight * pair.row;
    weights += weight;
    squares += weight * pair.residual_m * pair.residual_m;
  }
  if (weights > 0) sums.variance_m2 = squares / weights;
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
  const Equations sums = equations_of(pairs_of(fixed, moving, fixed_from_moving, about_m, block_m));
  if (sums.surfaces.size() < 12 || least_share(sums.normal_matrix) < 1e-5) return std::nullopt;
  Matrix6d scores = Matrix6d::Zero(), offsets = Matrix6d::Zero();
  for (const auto& [surface, sum] : sums.surfaces) {
    scores += sum.score * sum.score.transpose();
    offsets += sum.row * sum.row.transpose();
  }
  const auto surfaces = static_cast<double>(sums.surfaces.size());
  const Matrix6d spread = scores * (surfaces / (surfaces - 6)) + offsets * sums.variance_m2;
  const Matrix6d inverse = sums.normal_matrix.inverse();
  const Matrix6d covariance = inverse * spread * inverse;
  return TransformCovariance{(covariance + covariance.transpose()) / 2, about_m};
}

}  // namespace alea
