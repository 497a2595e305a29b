#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "alea/checkerboard/measurement.hpp"
#include "experiments/command/command.hpp"

namespace alea::command {

void add_measure_checkerboard(CLI::App& parent, int& exit_code);

/// --side, --squares.
struct BoardArguments {
  double side_m = 0;
  std::string squares = "2x2";
  std::string origin;
};
void add_board_options(CLI::App& app, BoardArguments& arguments);
/// Throws Error(usage).
BoardSpec board_spec(const BoardArguments& arguments);
BoardOptions board_options(const BoardArguments& arguments);

nlohmann::json measurement_json(const BoardMeasurement& measurement);

}  // namespace alea::command
