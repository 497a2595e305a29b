#include "experiments/checkerboard/sensor_trial.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/seed.hpp"

namespace alea::experiments::checkerboard {
namespace {

constexpr std::uint32_t experiment = 510;

BoardOptions options_for(const BoardSensor& sensor, double side_factor) {
  BoardOptions options;
  options.board.cell_m = side_factor * sensor.board_side_m / 2;
  return options;
}

Checkerboard model(const BoardSensor& sensor, SensorTarget target) {
  Checkerboard board;
  board.cell_m = sensor.board_side_m / 2;
  board.dark_intensity = 0.1;
  board.light_intensity = 0.8;
  board.plate_intensity = 0.5;
  if (target == SensorTarget::wall || target == SensorTarget::blank_plate)
    board.margin_m = 0.7 * sensor.board_side_m;
  if (target == SensorTarget::blank_plate) board.dark_intensity = board.light_intensity = 0.5;
  if (target == SensorTarget::faint) {  // a contrast below a fifth of the noise
    board.dark_intensity = 0.5;
    board.light_intensity = 0.5 + 0.2 * sensor.intensity_sd;
  }
  return board;
}

/// Points of nothing flat: leaves, say.
Cloud clutter(const BoardSensor& sensor, const Eigen::Vector3d& centre, RandomStream& stream) {
  Cloud cloud;
  cloud.scanner_position = Eigen::Vector3d::Zero();
  for (int k = 0; k < 1500; ++k) {
    const Eigen::Vector3d off(stream.uniform() - 0.5, stream.uniform() - 0.5,
                              stream.uniform() - 0.5);
    cloud.positions.push_back(centre + 3 * sensor.board_side_m * off);
    cloud.intensity.push_back(static_cast<float>(stream.uniform()));
  }
  return cloud;
}

Eigen::Vector3d in_ball(RandomStream& stream) {
  while (true) {
    const Eigen::Vector3d at(2 * stream.uniform() - 1, 2 * stream.uniform() - 1,
                             2 * stream.uniform() - 1);
    if (at.norm() <= 1) return at;
  }
}

SensorOutcome judged(const Result<BoardMeasurement>& result, const SensorScene& scene) {
  SensorOutcome outcome;
  if (!result) return outcome;
  const Eigen::Vector3d error = result->centre_m - scene.scan_from_board.translation;
  outcome.measured = true;
  outcome.error_m = error.norm();
  if (result->bound) outcome.bound_m2 = result->bound->trace();
  if (result->covariance) outcome.nees = error.dot(result->covariance->inverse() * error);
  return outcome;
}

}  // namespace

SensorScene draw_scene(const BoardSensor& sensor, SensorTarget target, std::uint64_t seed,
                       std::uint64_t trial) {
  RandomStream layout({seed, experiment, trial, 1, Purpose::station});
  SensorScene scene;
  Eigen::Matrix3d facing;  // the board's z towards the scanner, its rows up
  facing << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  const auto tilt = [&] { return 20 * deg * (2 * layout.uniform() - 1); };
  const Eigen::Vector3d tilts(tilt(), tilt(), 0);
  const double turn = 2 * std::numbers::pi * layout.uniform();
  scene.scan_from_board = {facing * rotation_exp(tilts) * rotation_exp({0, 0, turn}),
                           {sensor.range_m, 0, 0}};
  scene.near_m = scene.scan_from_board.translation + 0.2 * sensor.board_side_m * in_ball(layout);
  const double axis = 2 * std::numbers::pi * layout.uniform();
  const Eigen::Vector3d out_of_plane(std::cos(axis), std::sin(axis), 0);
  scene.start = {scene.scan_from_board.rotation * rotation_exp(10 * deg * out_of_plane) *
                     rotation_exp({0, 0, layout.uniform() < 0.5 ? -10 * deg : 10 * deg}),
                 scene.near_m};
  if (target == SensorTarget::no_plate) {
    scene.cloud = clutter(sensor, scene.scan_from_board.translation, layout);
    return scene;
  }
  scene.cloud = scan_board(model(sensor, target), scene.scan_from_board, sensor,
                           {seed, experiment, trial, 0, Purpose::experiment});
  if (target == SensorTarget::three_points) {
    const auto n = static_cast<std::uint32_t>(scene.cloud.size());
    scene.cloud = subset(scene.cloud, {n / 5, n / 2, 4 * n / 5});
    scene.cloud.scanner_position = Eigen::Vector3d::Zero();
  }
  return scene;
}

SensorOutcome measure_likelihood(const BoardSensor& sensor, const SensorScene& scene,
                                 double side_factor) {
  return judged(measure_by_likelihood(scene.cloud, scene.near_m, options_for(sensor, side_factor)),
                scene);
}

SensorOutcome measure_pipeline(const BoardSensor& sensor, const SensorScene& scene,
                               const ColouredBoardOptions& steps) {
  ColouredBoardOptions options = steps;
  options.start = scene.start;
  return judged(measure_by_coloured_icp(scene.cloud, scene.near_m, options_for(sensor, 1), options),
                scene);
}

}  // namespace alea::experiments::checkerboard
