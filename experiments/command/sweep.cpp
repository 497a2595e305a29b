#include "experiments/command/sweep.hpp"

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "experiments/command/command.hpp"
#include "experiments/engine/configuration.hpp"
#include "experiments/engine/sweep_run.hpp"

namespace alea::command {
namespace {

using namespace experiments;

struct Sweep {
  std::string file, out, shard = "1/1";
  bool smoke = false, resume = false, seed_given = false;
  CommonOptions common;
};

std::atomic<bool> stop_wanted = false;

// The first Ctrl-C lets the trials that run come to an end and stores them; the second ends at
// once, which costs what was not yet committed.
extern "C" void on_stop(int signal) {
  stop_wanted = true;
  std::signal(signal, SIG_DFL);
}

TrialStore open_store(const Sweep& sweep, const SweepSpec& spec, const Shard& shard) {
  const std::filesystem::path folder(sweep.out);
  if (!sweep.resume || !std::filesystem::exists(folder / TrialStore::file_name))
    return TrialStore::create(folder, spec, shard);
  TrialStore store = TrialStore::resume(folder);
  std::string difference = configuration_difference(store.configuration(), configuration_of(spec));
  if (difference.empty() && !(store.shard() == shard))
    difference =
        fmt::format("shard is {} there and {} now", to_text(store.shard()), to_text(shard));
  if (!difference.empty())
    throw input_error(
        fmt::format("{}: made by another configuration ({}); choose another --out, or run with the "
                    "old one",
                    (folder / TrialStore::file_name).string(), difference));
  return store;
}

nlohmann::json summary_json(const TrialStore& store, const SweepRunSummary& summary) {
  const SweepSpec& spec = store.spec();
  return {{"sweep", spec.name},
          {"status", summary.interrupted ? "interrupted" : "done"},
          {"cells", spec.cells()},
          {"trials_per_cell", spec.trials},
          {"estimators", spec.estimators},
          {"shard", to_text(store.shard())},
          {"trials_before", summary.before},
          {"trials_added", summary.added},
          {"duration_s", summary.duration_s}};
}

int run(const Sweep& sweep) {
  const ThreadLimit limit(sweep.common.threads);
  SweepSpec spec = load_sweep(sweep.file, sweep.smoke);
  if (sweep.seed_given) spec.seed = sweep.common.seed;
  TrialStore store = open_store(sweep, spec, parse_shard(sweep.shard));
  store.begin_run(this_run());
  stop_wanted = false;
  std::signal(SIGINT, on_stop);
  std::signal(SIGTERM, on_stop);
  SweepRunOptions options;
  options.stop = &stop_wanted;
  options.progress = make_progress(sweep.common);
  const SweepRunSummary summary = run_sweep(store, options);
  write_json(sweep.common, summary_json(store, summary));
  const std::uint64_t done = summary.before + summary.added;
  if (summary.interrupted) {
    fmt::print(stderr, "alea: interrupted: {} trials are stored; continue with --resume\n", done);
    return exit_interrupted;
  }
  if (sweep.common.json != "-")
    fmt::print("{}: {} trials in {} cells, {} of them new, {:.1f} s; {}\n", spec.name, done,
               spec.cells(), summary.added, summary.duration_s,
               (std::filesystem::path(sweep.out) / TrialStore::file_name).string());
  return exit_done;
}

}  // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  auto sweep = std::make_shared<Sweep>();
  CLI::App* sub = app.add_subcommand(
      "sweep", "Run an experiment over a grid of settings, resumable, and keep every trial");
  sub->add_option("sweep", sweep->file, "Sweep file (TOML, experiments/engine/README.md)");
  sub->add_option("--out", sweep->out, "Folder of results.sqlite; made if missing");
  sub->add_flag("--smoke", sweep->smoke, "The small size of the sweep file");
  sub->add_flag("--resume", sweep->resume,
                "Continue a store that is there (or begin one): verifies it, adds what it lacks");
  sub->add_option("--shard", sweep->shard, "K/N: only every N-th trial, the K-th of them, from 1")
      ->capture_default_str();
  add_common_options(*sub, sweep->common);
  sub->get_option("--seed")->description("Seed instead of the sweep file's")->default_str("");
  add_sweep_merge(*sub, exit_code);
  add_sweep_export(*sub, exit_code);
  sub->require_subcommand(0, 1);
  sub->callback([sub, sweep, &exit_code] {
    if (!sub->get_subcommands().empty()) return;
    if (sweep->file.empty() || sweep->out.empty())
      throw usage_error("sweep: give a sweep file and --out DIR; see alea sweep --help");
    sweep->seed_given = sub->get_option("--seed")->count() > 0;
    exit_code = run(*sweep);
  });
}

}  // namespace alea::command
