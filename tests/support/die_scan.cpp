#include "tests/support/die_scan.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "alea/simulate/scanner.hpp"

namespace alea::test {

DieScan scan_die(const DieModel& model, double distance_m, double step_rad, Scene others,
                 std::uint64_t trial, const Scanner& scanner) {
  DieModel standing = model;
  standing.scene_from_die.translation = {0, 0, model.size_m[0] / 2};
  others.dice.insert(others.dice.begin(), build_die(standing));
  Patch floor;
  floor.corner_m = {-3, -3, 0};
  floor.side_u_m = {6, 0, 0}, floor.side_v_m = {0, 6, 0};
  others.patches.push_back(floor);
  const double diagonal = distance_m / std::numbers::sqrt2;
  const RigidTransform pose = levelled_pose({diagonal, diagonal, 1.6}, -2.1);
  BoundingBall ball = bounding_ball(others.dice[0]);
  ball.radius_m *= others.dice.size() + others.boxes.size() > 1 ? 4 : 1;
  Station station = aimed_station(pose, ball, step_rad, {0.3, 0.6});
  station.scanner = scanner;
  DieScan out;
  out.cloud = simulate_scan(others, station, {17, 1, trial, 0});
  const RigidTransform scan_from_scene = pose.inverse();
  out.centre_m = scan_from_scene * standing.scene_from_die.translation;
  for (std::size_t k = 0; k < 3; ++k) {
    const Plane& plane = others.dice[0].facets[static_cast<std::size_t>(out.pips[k]) - 1].plane;
    const Eigen::Vector3d normal = scan_from_scene.rotation * plane.normal;
    out.planes[k] = {normal, normal.dot(scan_from_scene * (plane.offset_m * plane.normal))};
  }
  return out;
}

std::array<PlaneRegion, 3> die_facets_of(const DieScan& scan) {
  std::array<PlaneRegion, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Plane& plane = scan.planes[k];
    PlaneRegion& region = out[k];
    for (std::uint32_t i = 0; i < scan.cloud.size(); ++i) {
      const Eigen::Vector3d& p = scan.cloud.positions[i];
      bool outside = std::abs(plane.signed_distance(p)) > 0.006;
      for (const Plane& other : scan.planes) outside |= other.signed_distance(p) > 0.006;
      outside |= scan.planes[0].signed_distance(p) < -0.49;  // the floor
      if (outside) continue;
      region.indices.push_back(i);
      region.centroid_m += p;
    }
    region.centroid_m /= static_cast<double>(region.indices.size());
    const Eigen::Vector3d tilt = 0.003 * tangent_basis(plane.normal).col(k % 2);
    region.plane.normal = (plane.normal + tilt).normalized();
    region.plane.offset_m = region.plane.normal.dot(region.centroid_m);
  }
  return out;
}

}  // namespace alea::test
