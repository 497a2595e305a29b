#pragma once

#include "experiments/command/command.hpp"

namespace alea::command {

/// Adds `spheres` to the subcommand `register`.
void add_register_spheres(CLI::App& parent, int& exit_code);

}  // namespace alea::command
