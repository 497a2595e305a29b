#include "alea/die/orthogonal_axes.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "alea/core/error.hpp"

namespace alea {
namespace {

/// Equations (1) to (3) with axis `fixed` in the place of Z.
Eigen::Matrix3d fix_axis(const Eigen::Matrix3d& axes, int fixed) {
  const int next = (fixed + 1) % 3, last = (fixed + 2) % 3;
  Eigen::Matrix3d v;
  v.col(fixed) = axes.col(fixed);                                 // Equation (1)
  v.col(next) = axes.col(last).cross(v.col(fixed)).normalized();  // Equation (2)
  v.col(last) = v.col(fixed).cross(v.col(next));                  // Equation (3), corrected
  return v;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& axes) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// Columns along, across, along x across, with `across` made perpendicular to `along`.
Eigen::Matrix3d axes_from(const Eigen::Vector3d& along, const Eigen::Vector3d& across) {
  Eigen::Matrix3d axes;
  axes.col(0) = along.normalized();
  axes.col(1) = (across - axes.col(0) * axes.col(0).dot(across)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Columns X, Y, Z with Z = up and X as near to `heading` as that allows.
Eigen::Matrix3d upright_axes(const Eigen::Vector3d& up, const Eigen::Vector3d& heading) {
  Eigen::Matrix3d axes;
  axes.col(2) = up;
  axes.col(1) = up.cross(heading).normalized();
  axes.col(0) = axes.col(1).cross(up);
  return axes;
}

const Eigen::Vector3d& normal_of(const ObservedDie& die, int pips) {
  const ObservedFacet* const facet = find_facet(die, pips);
  if (facet == nullptr) throw usage_error("edge axes: the scan does not see a named facet");
  return facet->fit.plane.normal;
}

}  // namespace

Eigen::Matrix3d orthogonal_axes(const CornerFrame& frame, FrameRule rule) {
  switch (rule) {
    case FrameRule::fix_x:
      return fix_axis(frame.axes, 0);
    case FrameRule::fix_y:
      return fix_axis(frame.axes, 1);
    case FrameRule::fix_z:
      return fix_axis(frame.axes, 2);
    case FrameRule::polar:
      return nearest_rotation(frame.axes);
    case FrameRule::top_normal:
      // X lies in the upper facet, so it is perpendicular to its normal as it is.
      return upright_axes(frame.normals.col(2), frame.axes.col(0));
    case FrameRule::mean_heading:
      break;
  }
  const Eigen::Vector3d& up = frame.normals.col(2);
  const Eigen::Vector3d x = (frame.normals.col(0) - up * up.dot(frame.normals.col(0))).normalized();
  return upright_axes(up, x + frame.normals.col(1).cross(up).normalized());
}

Eigen::Matrix3d orthogonal_axes_as_printed(const CornerFrame& frame) {
  Eigen::Matrix3d v = fix_axis(frame.axes, 2);
  v.col(1) = v.col(0).cross(v.col(2));  // Equation (3) as printed
  return v;
}

Eigen::Matrix3d edge_axes(const ObservedDie& die, int first_pips, int second_pips,
                          int normal_pips) {
  const Eigen::Vector3d edge = normal_of(die, first_pips).cross(normal_of(die, second_pips));
  return axes_from(edge, normal_of(die, normal_pips));
}

Eigen::Matrix3d edge_axes(const ObservedDie& die, int first_pips, int second_pips) {
  const Eigen::Vector3d &first = normal_of(die, first_pips), &second = normal_of(die, second_pips);
  return axes_from(first.cross(second), first + second);
}

}  // namespace alea
