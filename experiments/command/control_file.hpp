#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "alea/pipeline/site_tie.hpp"

namespace alea::command {

/// Where the site's coordinates and the measured points come from.
struct ControlOptions {
  std::string control_file;  ///< name X Y Z [sd], site system, metres
  std::string targets_file;  ///< name x y z [sd], master frame, metres
};

/// Adds --control and --targets.
void add_control_options(CLI::App& app, ControlOptions& options);

/// One point a line: name, three coordinates and, where known, a standard deviation (m); separated
/// by blanks, tabs, commas or semicolons; '#' begins a comment. Throws Error(input) naming file and
/// line.
std::vector<NamedPoint> read_named_points(const std::string& path);

/// Ties every registration to the site; one that cannot be tied is refused. Without --control
/// nothing happens. `measured`: points of the master frame where --targets is not given.
void tie_to_control(const ControlOptions& options, const std::vector<NamedPoint>& measured,
                    std::vector<Registration>& registrations);

}  // namespace alea::command
