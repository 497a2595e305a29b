#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include "alea/core/parallel.hpp"
#include "experiments/command/command.hpp"
#include "experiments/die/reproduce_die.hpp"

namespace alea::command {
namespace {

struct ReproduceOptions {
  CommonOptions common;
  std::string paper;
  std::string out;
  bool smoke = false;
};

int reproduce(const ReproduceOptions& options) {
  const ThreadLimit limit(options.common.threads);
  const ProgressCallback progress = make_progress(options.common);
  namespace fs = std::filesystem;
  const std::string folder = (fs::path(options.out) / "die").string();
  const std::string report =
      experiments::die::reproduce_die({folder, options.smoke, options.common.seed, progress});
  fmt::print("{}\ntables and pictures: {}\n", report, fs::absolute(folder).string());
  return exit_done;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App* const command =
      app.add_subcommand("reproduce", "Repeat a paper: its tables, statements and figures");
  command->add_option("paper", options->paper, "die, or all")
      ->required()
      ->check(CLI::IsMember({"die", "all"}));
  command->add_option("--out", options->out, "Folder of the results; each paper has its own in it")
      ->required();
  command->add_flag("--smoke", options->smoke, "Few trials: minutes instead of an hour");
  command->add_option("--threads", options->common.threads, "Threads (0: all cores)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seed", options->common.seed, "Seed of every random choice")
      ->capture_default_str();
  command->add_flag("--quiet", options->common.quiet, "No progress on standard error");
  command->callback([options, &exit_code] { exit_code = reproduce(*options); });
}

}  // namespace alea::command
