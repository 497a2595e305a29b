#pragma once

#include "experiments/command/command.hpp"

namespace alea::command {

// The kinds of `alea register`, each in its own file.
void add_register_die(CLI::App& parent, int& exit_code);
void add_register_spheres(CLI::App& parent, int& exit_code);
void add_register_markerless(CLI::App& parent, int& exit_code);
void add_register_network(CLI::App& parent, int& exit_code);
void add_register_planes(CLI::App& parent, int& exit_code);
void add_register_checkerboards(CLI::App& parent, int& exit_code);

}  // namespace alea::command
