#include "alea/transform/horn.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "alea/core/error.hpp"

namespace alea {
namespace {

void require_valid(std::size_t to_count, std::size_t from_count, std::span<const double> weights) {
  if (to_count != from_count || to_count < 3)
    throw usage_error("horn: needs at least three points and the same number in both frames");
  if (!weights.empty() && weights.size() != to_count)
    throw usage_error("horn: needs one weight for each pair of points, or none");
  for (const double weight : weights)
    if (!(weight > 0)) throw usage_error("horn: each weight must be positive");
}

Eigen::Vector3d weighted_centroid(std::span<const Eigen::Vector3d> points,
                                  std::span<const double> weights) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // about the first point: far origins cost nothing
  double weight_sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = weights.empty() ? 1.0 : weights[i];
    sum += weight * (points[i] - points[0]);
    weight_sum += weight;
  }
  return points[0] + sum / weight_sum;
}

/// Horn's symmetric 4x4 matrix N (his section 4.A); s(a, b) is the sum of from_a * to_b.
Eigen::Matrix4d quaternion_form(const Eigen::Matrix3d& s) {
  Eigen::Matrix4d n;
  n.row(0) << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0);
  n.row(1) << n(0, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2);
  n.row(2) << n(0, 2), n(1, 2), -s(0, 0) + s(1, 1) - s(2, 2), s(1, 2) + s(2, 1);
  n.row(3) << n(0, 3), n(1, 3), n(2, 3), -s(0, 0) - s(1, 1) + s(2, 2);
  return n;
}

}  // namespace

RigidTransform horn(std::span<const Eigen::Vector3d> to_points,
                    std::span<const Eigen::Vector3d> from_points, std::span<const double> weights) {
  require_valid(to_points.size(), from_points.size(), weights);
  const Eigen::Vector3d to_centroid = weighted_centroid(to_points, weights);
  const Eigen::Vector3d from_centroid = weighted_centroid(from_points, weights);
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < to_points.size(); ++i) {
    const double weight = weights.empty() ? 1.0 : weights[i];
    sums += weight * (from_points[i] - from_centroid) * (to_points[i] - to_centroid).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(quaternion_form(sums));
  const Eigen::Vector4d q = solver.eigenvectors().col(3);  // of the largest eigenvalue
  RigidTransform to_from_from;
  to_from_from.rotation = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().matrix();
  to_from_from.translation = to_centroid - to_from_from.rotation * from_centroid;
  return to_from_from;
}

}  // namespace alea
