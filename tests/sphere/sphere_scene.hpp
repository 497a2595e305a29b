#pragma once

#include <cmath>
#include <vector>

#include "alea/simulate/scanner.hpp"

namespace alea::test {

inline constexpr double ball_radius_m = 0.0725;

/// Six places about the origin, no two distances alike.
inline std::vector<Eigen::Vector3d> ball_places() {
  return {{1.9, 0.3, 0.4},   {0.8, 1.7, 1.1},    {-1.1, 1.2, 0.25},
          {-1.7, -0.6, 1.4}, {-0.2, -1.9, 0.55}, {1.5, -1.2, 0.9}};
}

inline Patch patch(const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                   const Eigen::Vector3d& v) {
  Patch out;
  out.corner_m = corner;
  out.side_u_m = u;
  out.side_v_m = v;
  return out;
}

/// A room of 8 x 7 x 3 m with boxes, a column and a pipe of the spheres' radius.
inline Scene furnished_room(const std::vector<Eigen::Vector3d>& balls) {
  Scene scene;
  const Eigen::Vector3d x(8, 0, 0), y(0, 7, 0), z(0, 0, 3);
  const Eigen::Vector3d low(-4, -3.5, 0);
  scene.patches = {patch(low, x, y), patch(low, x, z), patch(low, y, z), patch(low + y, x, z),
                   patch(low + x, y, z)};
  for (const auto& [place, size] : std::vector<std::pair<Eigen::Vector3d, double>>{
           {{3, 2, 0.4}, 0.8}, {{-3, 2.5, 0.15}, 0.3}}) {
    Box box;
    box.size_m = Eigen::Vector3d::Constant(size);
    box.scene_from_box.translation = place;
    scene.boxes.push_back(box);
  }
  Cylinder column{"column", {2.8, -2.6, 0}, {0, 0, 3}, 0.25, 0.5};
  Cylinder pipe{"pipe", {-3.2, -2.8, 0}, {0, 0, 2}, ball_radius_m, 0.5};
  scene.cylinders = {column, pipe};
  for (const Eigen::Vector3d& place : balls)
    scene.spheres.push_back({"", place, ball_radius_m, 0.9});
  return scene;
}

inline Station room_station(const RigidTransform& scene_from_scan, double step_rad) {
  Station station;
  station.scene_from_scan = scene_from_scan;
  station.azimuth.step_rad = step_rad;
  station.elevation = {-0.9, 0.5, step_rad};
  return station;
}

}  // namespace alea::test
