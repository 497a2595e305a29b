#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "experiments/command/command.hpp"
#include "experiments/command/sweep.hpp"
#include "experiments/engine/sweep_export.hpp"

namespace alea::command {
namespace {

struct Merge {
  std::vector<std::string> folders;
  std::string out;
};

struct Export {
  std::string folder, csv;
};

int merge(const Merge& options) {
  const std::vector<std::filesystem::path> folders(options.folders.begin(), options.folders.end());
  const std::uint64_t trials = experiments::merge_stores(folders, options.out);
  fmt::print("{} stores, {} trials: {}\n", folders.size(), trials,
             (std::filesystem::path(options.out) / experiments::TrialStore::file_name).string());
  return exit_done;
}

int export_store(const Export& options) {
  auto store = experiments::TrialStore::read(options.folder);
  const std::uint64_t rows = experiments::export_csv(store, options.csv);
  if (!store.complete())
    fmt::print(stderr, "alea: {} of {} trials are stored so far; the rest is not in {}\n",
               store.done_units(), store.shard().size(store.spec().units()), options.csv);
  fmt::print("{} rows: {}\n", rows, options.csv);
  return exit_done;
}

}  // namespace

void add_sweep_merge(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<Merge>();
  CLI::App* sub = sweep.add_subcommand(
      "merge", "Join the stores of all shards; refuses gaps, doubles and another configuration");
  sub->add_option("folders", options->folders, "Folders of the shards")->required();
  sub->add_option("--out", options->out, "Folder of the joined store; made if missing")->required();
  sub->callback([options, &exit_code] { exit_code = merge(*options); });
}

void add_sweep_export(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<Export>();
  CLI::App* sub = sweep.add_subcommand("export", "Verify a store and write its rows as tidy CSV");
  sub->add_option("folder", options->folder, "Folder that alea sweep wrote")->required();
  sub->add_option("--csv", options->csv, "File to write; one row a trial and estimator")
      ->required();
  sub->callback([options, &exit_code] { exit_code = export_store(*options); });
}

}  // namespace alea::command
