#include "alea/plane/point_moments.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace alea {
namespace {

// Eigenvalues in ascending order of a symmetric matrix.
std::array<double, 3> eigenvalues(const Eigen::Matrix3d& m) {
  const double mean = m.trace() / 3;
  Eigen::Matrix3d centred = m;
  centred.diagonal().array() -= mean;
  const double p = std::sqrt(centred.squaredNorm() / 6);
  if (p <= 0) return {mean, mean, mean};
  const double half_determinant = (centred / p).determinant() / 2;
  const double angle = std::acos(std::clamp(half_determinant, -1.0, 1.0)) / 3;
  const double largest = mean + 2 * p * std::cos(angle);
  const double smallest = mean + 2 * p * std::cos(angle + 2.0943951023931953);  // 2 pi / 3
  return {smallest, 3 * mean - largest - smallest, largest};
}

// Unit vector of the null space of a matrix of rank two: the longest product of two rows.
Eigen::Vector3d null_vector(const Eigen::Matrix3d& m) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d product = m.row(i).cross(m.row((i + 1) % 3));
    if (product.squaredNorm() > best.squaredNorm()) best = product;
  }
  const double length = best.norm();
  if (!(length > 0)) return Eigen::Vector3d::UnitZ();
  return best / length;
}

}  // namespace

PointMoments merged(const PointMoments& a, const PointMoments& b) {
  if (a.count == 0) return b;
  if (b.count == 0) return a;
  PointMoments out;
  out.count = a.count + b.count;
  const Eigen::Vector3d shift = b.mean - a.mean;
  out.mean = a.mean + shift * (b.count / out.count);
  out.scatter =
      a.scatter + b.scatter + (a.count * b.count / out.count) * (shift * shift.transpose());
  return out;
}

MomentPlane plane_of(const PointMoments& moments) {
  const double scale = moments.scatter.trace();
  if (!(scale > 0)) return {};
  const Eigen::Matrix3d unit = moments.scatter / scale;
  const std::array<double, 3> values = eigenvalues(unit);
  Eigen::Matrix3d shifted = unit;
  shifted.diagonal().array() -= values[0];
  MomentPlane plane;
  plane.normal = null_vector(shifted);
  const double least = plane.normal.dot(moments.scatter * plane.normal);
  plane.thickness = std::sqrt(std::max(0.0, least) / moments.count);
  plane.breadth = std::sqrt(std::max(0.0, values[1] * scale) / moments.count);
  return plane;
}

}  // namespace alea
