#pragma once

#include "experiments/command/command.hpp"

namespace alea::command {

/// `alea calibrate` with its kinds.
void add_calibrate(CLI::App& app, int& exit_code);

// The kinds of `alea calibrate`, each in its own file.
void add_calibrate_die(CLI::App& parent, int& exit_code);

}  // namespace alea::command
