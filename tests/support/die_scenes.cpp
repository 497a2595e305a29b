#include "tests/support/die_scenes.hpp"

#include <cmath>
#include <numbers>

#include "alea/simulate/scanner.hpp"

namespace alea::testing {
namespace {

constexpr double scanner_height_m = 1.6;

RigidTransform station_pose(const TwoStationCase& scene_case, int scan) {
  const double azimuth = std::numbers::pi / 4 + (scan == 0 ? 0 : scene_case.station_angle_rad);
  const double horizontal_m =
      std::sqrt(scene_case.range_m * scene_case.range_m - scanner_height_m * scanner_height_m);
  const Eigen::Vector3d position(horizontal_m * std::cos(azimuth), horizontal_m * std::sin(azimuth),
                                 scanner_height_m);
  return levelled_pose(position, 0.3 + 2.0 * scan);
}

void add_walls(Scene& scene) {
  scene.patches.push_back({"floor", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}});
  scene.patches.push_back({"wall x", {-4, -4, 0}, {0, 8, 0}, {0, 0, 3}});
  scene.patches.push_back({"wall y", {-4, -4.5, 0}, {8, 0, 0}, {0, 0, 3}});
  scene.patches.push_back({"wall y far", {-4, 4.5, 0}, {8, 0, 0}, {0, 0, 3}});
  scene.patches.push_back({"slanted", {-4, 2, 0}, {2, 1, 0}, {0, 0, 1}});
}

Scene scene_of(const TwoStationCase& scene_case, int scan) {
  Scene scene;
  DieModel model;
  model.size_m.setConstant(scene_case.edge_m);
  model.scene_from_die =
      standing_pose(model.chirality, 1, 2, 0, Eigen::Vector3d(0, 0, scene_case.edge_m / 2));
  if (scene_case.change_die) scene_case.change_die(model, scan);
  scene.dice.push_back(build_die(model));
  if (scene_case.walls) add_walls(scene);
  if (scene_case.change_scene) scene_case.change_scene(scene, scan);
  return scene;
}

Cloud scan(const TwoStationCase& scene_case, const Scene& scene, int number, std::uint64_t trial) {
  const RigidTransform pose = station_pose(scene_case, number);
  Station station =
      aimed_station(pose,
                    {Eigen::Vector3d(0, 0, scene_case.edge_m / 2),
                     scene_case.window_m > 0 ? scene_case.window_m : scene_case.edge_m},
                    scene_case.step_rad);
  if (scene_case.walls) {
    station.azimuth = {-std::numbers::pi, std::numbers::pi, scene_case.step_rad};
    station.elevation = {-0.8, 0.3, scene_case.step_rad};
  }
  Cloud cloud = simulate_scan(scene, station, {1, 0, trial, static_cast<std::uint32_t>(number)});
  cloud.scanner_position = Eigen::Vector3d(0, 0, 0);
  return cloud;
}

}  // namespace

TwoScans scan_twice(const TwoStationCase& scene_case, std::uint64_t trial) {
  TwoScans out;
  const Scene of_master = scene_of(scene_case, 0);
  out.master = scan(scene_case, of_master, 0, trial);
  out.slave = scan(scene_case, scene_of(scene_case, 1), 1, trial);
  out.master_from_slave = station_pose(scene_case, 0).inverse() * station_pose(scene_case, 1);
  if (!of_master.dice.empty()) out.die = of_master.dice.front();
  return out;
}

}  // namespace alea::testing
