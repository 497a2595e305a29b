#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "alea/core/progress.hpp"
#include "alea/core/refusal.hpp"

namespace alea::command {

/// The documented exit codes of the program.
enum ExitCode {
  exit_done = 0,
  exit_failed = 1,  ///< an acceptance experiment missed its limit
  exit_usage = 2,
  exit_input = 3,
  exit_refused = 4,
  exit_internal = 5,
  exit_interrupted = 130
};

/// What every computing subcommand takes.
struct CommonOptions {
  std::string json;  ///< file for the result, "-" for standard output, empty for none
  int threads = 0;   ///< 0: all cores
  std::uint64_t seed = 1;
  bool quiet = false;
};

/// Adds --json, --threads, --seed and --quiet to a subcommand.
void add_common_options(CLI::App& app, CommonOptions& options);

/// Writes a result where --json says (atomically); does nothing where it was not given. Throws
/// Error(input).
void write_json(const CommonOptions& options, const nlohmann::json& result);

/// A progress bar with remaining time on a terminal, sparse lines elsewhere, nothing when quiet. On
/// standard error.
ProgressCallback make_progress(const CommonOptions& options);

/// The text without control characters, each replaced by a question mark: names and values out of a
/// file must not move a terminal's cursor or make a second line.
std::string one_line(std::string text);

/// Prints the one line that tells why a result was refused; returns exit_refused.
int report_refusal(const Refusal& refusal);

/// Parses "X,Y,Z" (metres). Throws Error(usage) naming `option`.
std::optional<std::array<double, 3>> parse_point(const std::string& option,
                                                 const std::string& text);

/// Adds one subcommand; its callback stores the exit code in `exit_code`.
using AddSubcommand = void (*)(CLI::App& app, int& exit_code);

void add_info(CLI::App& app, int& exit_code);
void add_acceptance(CLI::App& app, int& exit_code);
void add_reproduce(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_apply(CLI::App& app, int& exit_code);
void add_transform(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_register(CLI::App& app, int& exit_code);
void add_measure(CLI::App& app, int& exit_code);
void add_print(CLI::App& app, int& exit_code);

}  // namespace alea::command
