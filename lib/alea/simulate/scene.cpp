#include "alea/simulate/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/simulate/window.hpp"

namespace alea {

std::size_t AngleRange::count() const {
  if (!(step_rad > 0) || !(stop_rad >= start_rad)) return 0;
  return static_cast<std::size_t>(std::floor((stop_rad - start_rad) / step_rad + 1e-9)) + 1;
}

BoundingBall bounding_ball(const Die& die) {
  BoundingBall ball;
  for (const Eigen::Vector3d& corner : die.body.corners_m) ball.centre_m += corner / 8;
  for (const Eigen::Vector3d& corner : die.body.corners_m)
    ball.radius_m = std::max(ball.radius_m, (corner - ball.centre_m).norm());
  for (const DieFacet& facet : die.facets) ball.radius_m += std::max(0.0, facet.bow_m);
  return ball;
}

BoundingBall bounding_ball(const Patch& patch) {
  return {centre_of(patch), (patch.side_u_m + patch.side_v_m).norm() / 2};
}

BoundingBall bounding_ball(const Box& box) {
  return {box.scene_from_box.translation, box.size_m.norm() / 2};
}

BoundingBall bounding_ball(const Cylinder& cylinder) {
  return {cylinder.base_m + cylinder.axis_m / 2,
          std::hypot(cylinder.axis_m.norm() / 2,
                     std::max(cylinder.radius_m, cylinder.top_radius_m.value_or(0)))};
}

BoundingBall bounding_ball(const Sphere& sphere) {
  return {sphere.centre_m, sphere.radius_m};
}

BoundingBall bounding_ball(const Checkerboard& board) {
  return {board.scene_from_board.translation, half_plate_m(board).norm()};
}

BoundingBall bounding_ball(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.body.vertices) box.extend(vertex);
  BoundingBall ball{box.center(), 0};
  for (const Eigen::Vector3d& vertex : mesh.body.vertices)
    ball.radius_m = std::max(ball.radius_m, (vertex - ball.centre_m).norm());
  return ball;
}

Eigen::Vector2d half_plate_m(const Checkerboard& board) {
  const Eigen::Vector2d pattern = Eigen::Vector2d(board.columns, board.rows) * board.cell_m;
  return pattern / 2 + Eigen::Vector2d::Constant(board.margin_m);
}

RigidTransform levelled_pose(const Eigen::Vector3d& position_m, double heading_rad) {
  return {Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), position_m};
}

Station aimed_station(const RigidTransform& scene_from_scan, const BoundingBall& target,
                      double step_rad, const Eigen::Vector2d& phase) {
  const Eigen::Vector3d centre = scene_from_scan.inverse() * target.centre_m;
  const AngularWindow window = angular_window(centre, target.radius_m + 1e-3 * centre.norm());
  const auto grid = [step_rad](double low, double high, double shift) {
    const double start = (std::ceil(low / step_rad - shift) + shift) * step_rad;
    return AngleRange{start, std::max(start, high), step_rad};
  };
  Station station;
  station.scene_from_scan = scene_from_scan;
  station.azimuth = grid(window.azimuth_rad - window.half_width_rad,
                         window.azimuth_rad + window.half_width_rad, phase.x());
  station.elevation = grid(window.low_rad, window.high_rad, phase.y());
  return station;
}

Plane plane_of(const Patch& patch) {
  const Eigen::Vector3d normal = patch.side_u_m.cross(patch.side_v_m).normalized();
  return {normal, normal.dot(patch.corner_m)};
}

Eigen::Vector3d centre_of(const Patch& patch) {
  return patch.corner_m + (patch.side_u_m + patch.side_v_m) / 2;
}

}  // namespace alea
