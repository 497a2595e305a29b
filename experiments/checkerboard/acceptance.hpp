#pragma once

#include <vector>

#include "experiments/engine/acceptance.hpp"

namespace alea::acceptance {

/// The topics of the checkerboard, in the order in which they run.
std::vector<Topic> checkerboard_topics();

/// Line 1: success of coloured ICP over shift and rotation, identical data, 400 pairs a cell.
void run_basin(const Options& options, const Report& report);
/// Line 3: collapse of coloured ICP in a wall, and the global method, 1,000 trials a cell.
void run_global(const Options& options, const Report& report);
/// Line 4: survey-like and low-cost-like sensors, 1,000 scans each.
void run_sensors(const Options& options, const Report& report);
/// Line 5: refusals, 1,000 scenes of each kind, bad and good.
void run_refusals(const Options& options, const Report& report);
/// Line 6: time of one crop and of a scan of a million points.
void run_board_speed(const Options& options, const Report& report);

}  // namespace alea::acceptance
