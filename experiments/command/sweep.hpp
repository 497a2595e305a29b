#pragma once

#include <CLI/CLI.hpp>

namespace alea::command {

void add_sweep(CLI::App& app, int& exit_code);

/// The subcommands of `alea sweep`.
void add_sweep_merge(CLI::App& sweep, int& exit_code);
void add_sweep_export(CLI::App& sweep, int& exit_code);

}  // namespace alea::command
