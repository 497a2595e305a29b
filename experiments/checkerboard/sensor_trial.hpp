#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "alea/checkerboard/coloured_measurement.hpp"
#include "alea/simulate/board_sensor.hpp"

namespace alea::experiments::checkerboard {

/// A scene of one board (or of what only looks like one) before a sensor.
struct SensorScene {
  Cloud cloud;
  RigidTransform scan_from_board;
  Eigen::Vector3d near_m = Eigen::Vector3d::Zero();  ///< up to 20 % of the side off the centre
  RigidTransform start;  ///< of the template: there, turned by 10 + 10 deg from the truth
};

/// What stands before the sensor.
enum class SensorTarget { bare, wall, blank_plate, no_plate, faint, three_points };

/// Board tilted by up to 20 deg about both of its axes, turned at random.
SensorScene draw_scene(const BoardSensor& sensor, SensorTarget target, std::uint64_t seed,
                       std::uint64_t trial);

/// One measurement against the truth.
struct SensorOutcome {
  bool measured = false;
  double error_m = 0;
  double bound_m2 = 0;  ///< trace of the Fisher bound of these points
  double nees = 0;
};
SensorOutcome measure_likelihood(const BoardSensor& sensor, const SensorScene& scene,
                                 double side_factor = 1);
SensorOutcome measure_pipeline(const BoardSensor& sensor, const SensorScene& scene,
                               const ColouredBoardOptions& steps = {});

}  // namespace alea::experiments::checkerboard
