#include "experiments/markerless/twin_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alea::experiments::markerless {
namespace {

using std::numbers::pi;

double clearance_m(const BoundingBall& ball, const Eigen::Vector3d& place_m) {
  return (ball.centre_m - place_m).head<2>().norm() - ball.radius_m;
}

/// From a box as seen from above, in its own frame.
double clearance_m(const Box& box, const Eigen::Vector3d& place_m) {
  const Eigen::Vector3d in_box = box.scene_from_box.inverse() * place_m;
  const Eigen::Vector2d off =
      (in_box.head<2>().cwiseAbs() - box.size_m.head<2>() / 2).cwiseMax(0.0);
  return off.norm();
}

}  // namespace

double between(RandomStream& stream, double low, double high) {
  return std::lerp(low, high, stream.uniform());
}

Eigen::Vector3d polar(double distance_m, double direction_rad, double z_m) {
  return {distance_m * std::cos(direction_rad), distance_m * std::sin(direction_rad), z_m};
}

Box upright_box(const std::string& id, const Eigen::Vector3d& base_centre_m,
                const Eigen::Vector3d& size_m, double heading_rad, double intensity) {
  Box box;
  box.id = id;
  box.size_m = size_m;
  box.scene_from_box =
      levelled_pose(base_centre_m + Eigen::Vector3d(0, 0, size_m.z() / 2), heading_rad);
  box.intensity = intensity;
  return box;
}

void add_tree(Scene& scene, const std::string& id, const Eigen::Vector3d& foot_m, double height_m,
              RandomStream& stream) {
  Cylinder trunk;
  trunk.id = id;
  trunk.base_m = foot_m - Eigen::Vector3d(0, 0, 0.3);
  trunk.axis_m = {between(stream, -0.05, 0.05) * height_m, between(stream, -0.05, 0.05) * height_m,
                  0.7 * height_m};
  trunk.radius_m = between(stream, 0.1, 0.22);
  trunk.top_radius_m = 0.6 * trunk.radius_m;
  trunk.intensity = 0.35;
  scene.cylinders.push_back(trunk);
  for (int k = 0; k < 3; ++k) {
    Sphere crown;
    crown.id = id + " crown";
    crown.centre_m = trunk.base_m + trunk.axis_m +
                     Eigen::Vector3d(between(stream, -0.6, 0.6), between(stream, -0.6, 0.6),
                                     between(stream, 0.0, 0.25 * height_m));
    crown.radius_m = between(stream, 0.12, 0.2) * height_m;
    crown.intensity = 0.3;
    scene.spheres.push_back(crown);
  }
}

bool is_clear(const Scene& scene, const Eigen::Vector3d& place_m, double margin_m) {
  for (const Box& box : scene.boxes)
    if (clearance_m(box, place_m) < margin_m) return false;
  for (const Sphere& sphere : scene.spheres)
    if (sphere.radius_m < 4 && clearance_m(bounding_ball(sphere), place_m) < margin_m) return false;
  for (const Cylinder& cylinder : scene.cylinders)
    if ((cylinder.base_m - place_m).head<2>().norm() - cylinder.radius_m < margin_m) return false;
  return true;
}

Station levelled_station(const std::string& name, const Eigen::Vector3d& position_m,
                         double heading_rad, double step_rad, double max_range_m) {
  Station station;
  station.name = name;
  station.scene_from_scan = levelled_pose(position_m, heading_rad);
  // 1e-9 rad short of a full turn, so that the first column is not measured twice.
  station.azimuth = {-pi, pi - step_rad + 1e-9, step_rad};
  station.elevation = {-65 * pi / 180, 88 * pi / 180, step_rad};
  station.scanner.noise = {0.003, 0, 0.001, 2.4e-5};
  station.scanner.intensity_noise = 0.03;
  station.scanner.max_range_m = max_range_m;
  return station;
}

}  // namespace alea::experiments::markerless
