#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "alea/io/scan_file.hpp"

namespace alea::command {

/// What every subcommand that reads scans takes.
struct ReadingOptions {
  std::string unit = "m";
  std::string columns;
  bool apply_pose = false;
};

/// Which points to keep while a file is read, so that files larger than memory can be thinned.
struct ThinningOptions {
  std::uint32_t decimate = 1;
  std::string crop;
};

/// Adds --unit, --columns and --apply-pose.
void add_reading_options(CLI::App& app, ReadingOptions& options);

/// Adds --decimate and --crop.
void add_thinning_options(CLI::App& app, ThinningOptions& options);

/// Applies them to `out`. Throws Error(usage).
void thin(const ThinningOptions& options, ReadOptions& out);

/// The same for the library. Throws Error(usage).
ReadOptions read_options(const ReadingOptions& options);

}  // namespace alea::command
