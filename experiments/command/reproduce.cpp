#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/parallel.hpp"
#include "alea/io/atomic_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reproduction_json.hpp"
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
  const experiments::die::Reproduction result =
      experiments::die::reproduce_die({folder, options.smoke, options.common.seed, progress});
  const nlohmann::json document =
      reproduction_json(result.tables, options.common.seed, options.smoke);
  write_file_atomically(fs::path(folder) / "tables.json", document.dump(2) + "\n");
  write_json(options.common, document);
  if (options.common.json == "-") return exit_done;
  for (const experiments::ResultTable& table : result.tables)
    fmt::print("{}\n", experiments::as_text(table));
  for (const experiments::ResultTable& table : result.tables)
    fmt::print("{}", experiments::summary_line(table));
  if (!result.no_pictures.empty()) fmt::print("{}\n", result.no_pictures);
  fmt::print("\ntables and pictures: {}\n", fs::absolute(folder).string());
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
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] { exit_code = reproduce(*options); });
}

}  // namespace alea::command
