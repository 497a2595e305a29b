#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/parallel.hpp"
#include "alea/io/atomic_file.hpp"
#include "experiments/checkerboard/reproduce_checkerboard.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reproduction_json.hpp"
#include "experiments/die/reproduce_die.hpp"
#include "experiments/markerless/reproduce_markerless.hpp"

namespace alea::command {
namespace {

struct ReproduceOptions {
  CommonOptions common;
  std::string paper;
  std::string out;
  bool smoke = false;
};

using Tables = std::vector<experiments::ResultTable>;

Tables reproduce_one(const ReproduceOptions& options, const std::string& paper,
                     const ProgressCallback& progress) {
  const std::string folder = (std::filesystem::path(options.out) / paper).string();
  if (paper == "checkerboard")
    return experiments::checkerboard::reproduce_checkerboard(
        {folder, options.smoke, options.common.seed, progress});
  if (paper == "markerless")
    return experiments::markerless::reproduce_markerless(
        {folder, options.smoke, options.common.seed, progress});
  experiments::die::Reproduction result =
      experiments::die::reproduce_die({folder, options.smoke, options.common.seed, progress});
  if (!result.no_pictures.empty()) fmt::print(stderr, "{}\n", result.no_pictures);
  return std::move(result.tables);
}

int reproduce(const ReproduceOptions& options) {
  const ThreadLimit limit(options.common.threads);
  const ProgressCallback progress = make_progress(options.common);
  Tables tables;
  for (const std::string paper : {"die", "checkerboard", "markerless"}) {
    if (options.paper != "all" && options.paper != paper) continue;
    Tables own = reproduce_one(options, paper, progress);
    const std::filesystem::path file = std::filesystem::path(options.out) / paper / "tables.json";
    write_file_atomically(
        file, reproduction_json(own, options.common.seed, options.smoke).dump(2) + "\n");
    for (experiments::ResultTable& table : own) {
      if (options.paper == "all") table.id = fmt::format("{}_{}", paper, table.id);
      tables.push_back(std::move(table));
    }
  }
  write_json(options.common, reproduction_json(tables, options.common.seed, options.smoke));
  if (options.common.json == "-") return exit_done;
  for (const experiments::ResultTable& table : tables)
    fmt::print("{}\n", experiments::as_text(table));
  for (const experiments::ResultTable& table : tables)
    fmt::print("{}", experiments::summary_line(table));
  fmt::print("\ntables and pictures: {}\n", std::filesystem::absolute(options.out).string());
  return exit_done;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App* const command =
      app.add_subcommand("reproduce", "Repeat a paper: its tables, statements and figures");
  command->add_option("paper", options->paper, "die, checkerboard, markerless, or all")
      ->required()
      ->check(CLI::IsMember({"die", "checkerboard", "markerless", "all"}));
  command->add_option("--out", options->out, "Folder of the results; each paper has its own in it")
      ->required();
  command->add_flag("--smoke", options->smoke, "Few trials: minutes instead of an hour");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] { exit_code = reproduce(*options); });
}

}  // namespace alea::command
