#include "experiments/command/measure.hpp"

namespace alea::command {

void add_measure(CLI::App& app, int& exit_code) {
  CLI::App* parent = app.add_subcommand("measure", "Measure a target in one scan");
  parent->require_subcommand(1);
  add_measure_checkerboard(*parent, exit_code);
}

}  // namespace alea::command
