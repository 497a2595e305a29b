#pragma once

#include "experiments/command/command.hpp"

namespace alea::command {

// The kinds of `alea calibrate`, each in its own file.
void add_calibrate_die(CLI::App& parent, int& exit_code);
void add_calibrate_noise(CLI::App& parent, int& exit_code);

}  // namespace alea::command
