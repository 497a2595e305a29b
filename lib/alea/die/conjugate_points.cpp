#include "alea/die/conjugate_points.hpp"

#include <Eigen/Geometry>

#include "alea/transform/horn.hpp"

namespace alea {
namespace {

Eigen::Vector3d outward(int pips) {
  return axis_side(pips) * Eigen::Vector3d::Unit(die_axis(pips));
}

/// The axes of a frame in the coordinates of a perfect die whose axis k points to the facet k + 1:
/// X and Y point inward along the edges, Z outward.
Eigen::Matrix3d ideal_axes(const FrameLabel& label) {
  Eigen::Matrix3d axes;
  axes << -outward(label.y_side), -outward(label.x_side), outward(label.up);
  return axes;
}

Eigen::Vector3d ideal_corner(const FrameLabel& label, const Eigen::Vector3d& lengths) {
  const Eigen::Vector3d side = outward(label.up) + outward(label.x_side) + outward(label.y_side);
  return side.cwiseProduct(lengths) / 2;
}

}  // namespace

RigidTransform v_from_u(const FrameLabel& v, const FrameLabel& u, const DieDimensions& dimensions,
                        const PrintedErrors& errors) {
  const Eigen::Vector3d lengths(dimensions.from_1_to_6_m, dimensions.from_2_to_5_m,
                                dimensions.from_3_to_4_m);
  const Eigen::Matrix3d v_from_die = ideal_axes(v).transpose();
  RigidTransform transform;
  transform.rotation = v_from_die * ideal_axes(u);  // R3(Omega)
  if (errors.reversed_turn) transform.rotation.transposeInPlace();
  transform.translation = v_from_die * (ideal_corner(u, lengths) - ideal_corner(v, lengths));
  if (errors.opposite_offset) {
    const Eigen::Vector3d along = (v_from_die * lengths).cwiseAbs();
    transform.translation << along.x(), along.y(), 0;
  }
  transform.translation.z() += dimensions.lift_m;
  return transform;
}

ConjugatePoints conjugate_points(const OrthogonalFrame& v, const OrthogonalFrame& u,
                                 const DieDimensions& dimensions, const PrintedErrors& errors) {
  const Eigen::Vector3d v_corner = errors.no_corner ? Eigen::Vector3d::Zero() : v.corner_m;
  const Eigen::Vector3d u_corner = errors.no_corner ? Eigen::Vector3d::Zero() : u.corner_m;
  const RigidTransform turn = v_from_u(v.label, u.label, dimensions, errors);
  ConjugatePoints points;
  for (int k = 0; k < 3; ++k) {
    points.v_in_master[k] = v_corner + v.axes.col(k);      // Equation (5)
    points.v_in_die[k] = Eigen::Vector3d::Unit(k);         // Equation (6)
    points.u_in_die[k] = turn * Eigen::Vector3d::Unit(k);  // Equation (7)
    points.u_in_slave[k] = u_corner + u.axes.col(k);       // Equation (8)
  }
  if (errors.direct_pairing) {
    // The points of equation (7) in the master's scan, so that they pair with (8) at once.
    for (int k = 0; k < 3; ++k) {
      points.v_in_master[k] = v_corner + v.axes * points.u_in_die[k];
      points.v_in_die[k] = points.u_in_die[k];
    }
  }
  return points;
}

RigidTransform register_conjugate(const ConjugatePoints& points, const PrintedErrors& errors) {
  if (errors.direct_pairing) return horn(points.v_in_master, points.u_in_slave);
  const RigidTransform master_from_die = horn(points.v_in_master, points.v_in_die);
  const RigidTransform die_from_slave = horn(points.u_in_die, points.u_in_slave);
  return master_from_die * die_from_slave;
}

}  // namespace alea
