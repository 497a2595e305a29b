#include "experiments/command/calibrate.hpp"

namespace alea::command {

void add_calibrate(CLI::App& app, int& exit_code) {
  CLI::App* parent =
      app.add_subcommand("calibrate", "Estimate what a registration can be given beforehand");
  parent->require_subcommand(1);
  for (const AddSubcommand add : {add_calibrate_die, add_calibrate_noise}) add(*parent, exit_code);
}

}  // namespace alea::command
