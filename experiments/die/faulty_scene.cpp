#include "experiments/die/faulty_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/seed.hpp"
#include "alea/simulate/scanner.hpp"

namespace alea::experiments::die {
namespace {

constexpr std::uint32_t faulty_scene_number = 25;

/// One scene drawn from its own stream.
struct Trial {
  Fault fault;
  RandomStream random;
  double edge_m, range_m, step_rad;
  std::array<double, 2> azimuth_rad;  ///< of the stations, as seen from the die
};

Trial draw(Fault fault, std::uint64_t seed, std::uint64_t number) {
  Trial out{fault, RandomStream({seed, faulty_scene_number, number, 0, Purpose::scene_layout}),
            0,     0,
            0,     {}};
  out.edge_m = 0.3 + 0.3 * out.random.uniform();
  out.range_m = (6 + 6 * out.random.uniform()) * out.edge_m + 1;
  out.step_rad = out.edge_m / out.range_m / (25 + 25 * out.random.uniform());
  const double first = (30 + 30 * out.random.uniform()) * deg;
  out.azimuth_rad = {first, first + (75 + 30 * out.random.uniform()) * deg};
  if (fault == Fault::two_facets) out.azimuth_rad[1] = std::numbers::pi;  // straight at one side
  return out;
}

DieModel draw_die(Trial& trial, std::uint32_t scan) {
  DieModel model;
  model.size_m.setConstant(trial.edge_m);
  model.edge_radius_m = 0.02 * trial.edge_m * trial.random.uniform();
  const auto up = static_cast<int>(trial.random.below(6)) + 1;
  const int front = up % 3 + 1 == 7 - up ? up % 3 + 2 : up % 3 + 1;
  if (trial.fault == Fault::box_without_pips) {
    model.size_m = trial.edge_m * Eigen::Vector3d(1.4 + trial.random.uniform(), 1,
                                                  0.6 + 0.3 * trial.random.uniform());
    model.pips.painted = false;
  }
  if (trial.fault == Fault::blank_cube) model.pips.painted = false;
  if (trial.fault == Fault::other_hand || (trial.fault == Fault::mirrored_scan && scan == 1))
    model.chirality = Chirality::counterclockwise;
  if (trial.fault == Fault::skewed)
    model.facets[static_cast<std::size_t>(up) - 1].tilt_u_rad =
        (23 + 10 * trial.random.uniform()) * deg;
  if (trial.fault == Fault::wrong_size) {
    const double share = trial.random.uniform();
    model.size_m *= trial.random.uniform() < 0.5 ? 0.55 + 0.2 * share : 1.3 + 0.4 * share;
  }
  model.scene_from_die = standing_pose(model.chirality, up, front, 0,
                                       Eigen::Vector3d(0, 0, model.size_m.maxCoeff() / 2));
  return model;
}

void furnish(Trial& trial, Scene& scene) {
  for (int k = 0; k < 6; ++k) {
    Box box;
    for (int axis = 0; axis < 3; ++axis)
      box.size_m[axis] = trial.edge_m * (0.7 + 1.3 * trial.random.uniform());
    // One of them has the die's size.
    if (k == 0) box.size_m.setConstant(trial.edge_m);
    const double azimuth = 2 * std::numbers::pi * trial.random.uniform();
    const double distance = trial.edge_m * (k == 0 ? 0.5 : 2.0 + trial.random.uniform());
    box.scene_from_box.rotation =
        rotation_exp({0, 0, 2 * std::numbers::pi * trial.random.uniform()});
    box.scene_from_box.translation = {distance * std::cos(azimuth), distance * std::sin(azimuth),
                                      box.size_m.z() / 2};
    box.intensity = 0.2 + 0.7 * trial.random.uniform();
    scene.boxes.push_back(box);
  }
}

Scene build(Trial trial, std::uint32_t scan) {
  Scene scene;
  Patch floor;
  floor.corner_m = {-10, -10, 0};
  floor.side_u_m = {20, 0, 0}, floor.side_v_m = {0, 20, 0};
  scene.patches.push_back(floor);
  Patch wall;
  // Behind every station: these stand at most 9 m from the die.
  wall.corner_m = {-9.5, -1.5, 0};
  wall.side_u_m = {0, 11, 0}, wall.side_v_m = {0, 0, 3};
  scene.patches.push_back(wall);
  wall.side_u_m = {19, 0, 0};
  scene.patches.push_back(wall);
  if (trial.fault == Fault::furnished_room)
    furnish(trial, scene);
  else if (trial.fault != Fault::empty_room)
    scene.dice.push_back(build_die(draw_die(trial, scan)));
  return scene;
}

Cloud scan(const Trial& trial, std::uint64_t seed, std::uint64_t number, std::uint32_t index) {
  const double height_m = 1.5;
  const double along_m =
      std::sqrt(std::max(1.0, trial.range_m * trial.range_m - height_m * height_m));
  const double azimuth = trial.azimuth_rad[index];
  const RigidTransform pose = levelled_pose(
      {along_m * std::cos(azimuth), along_m * std::sin(azimuth), height_m}, azimuth + 2.5);
  const bool room = trial.fault == Fault::empty_room || trial.fault == Fault::furnished_room;
  const BoundingBall target{{0, 0, trial.edge_m / 2}, trial.edge_m * (room ? 3 : 1.6)};
  Station station = aimed_station(pose, target, trial.step_rad * (room ? 1.4 : 1));
  station.scanner.beam_diameter_m = 0.004;
  Cloud cloud =
      simulate_scan(build(trial, index), station, {seed, faulty_scene_number, number, index});
  cloud.scanner_position = Eigen::Vector3d::Zero();
  return cloud;
}

}  // namespace

FaultyScans draw_faulty_scans(Fault fault, std::uint64_t seed, std::uint64_t number) {
  const Trial trial = draw(fault, seed, number);
  return {scan(trial, seed, number, 0), scan(trial, seed, number, 1), trial.edge_m};
}

}  // namespace alea::experiments::die
