#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "alea/io/scan_file.hpp"

namespace alea::command {

/// What every subcommand that reads scans takes.
struct ReadingOptions {
  std::string unit = "m";
  std::string columns;
  bool apply_pose = false;
};

/// Adds --unit, --columns and --apply-pose.
void add_reading_options(CLI::App& app, ReadingOptions& options);

/// The same for the library. Throws Error(usage).
ReadOptions read_options(const ReadingOptions& options);

}  // namespace alea::command
