#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/comparable_rows.hpp"
#include "experiments/engine/scratch_folder.hpp"
#include "experiments/engine/sweep_acceptance.hpp"
#include "experiments/engine/sweep_export.hpp"
#include "experiments/engine/sweep_run.hpp"

namespace alea::acceptance {
namespace {

namespace fs = std::filesystem;
using experiments::all_rows;
using experiments::comparable_rows;
using experiments::ScratchFolder;
using experiments::Shard;
using experiments::SweepRunOptions;
using experiments::SweepSpec;
using experiments::TrialStore;

/// A sweep of some seconds: four cells of small scans.
fs::path sweep_file(const ScratchFolder& scratch, std::uint64_t trials) {
  const fs::path file = scratch.path() / "sweep.toml";
  std::ofstream(file) << "schema = 1\nname = \"acceptance\"\nexperiment = \"die\"\n"
                         "estimators = [\"closed_form\", \"paper\"]\n"
                      << "trials = " << trials << "\n[base]\nstep_mrad = 2.5\n"
                      << "[[axis]]\nname = \"range_noise_mm\"\nvalues = [0.5, 2]\n"
                         "[[axis]]\nname = \"tilt_deg\"\nvalues = [0, 1]\n";
  return file;
}

/// Starts this program on a sweep, quietly.
pid_t start_sweep(const fs::path& file, const fs::path& out) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int null = ::open("/dev/null", O_WRONLY);
    ::dup2(null, STDOUT_FILENO);
    ::execl("/proc/self/exe", "alea", "sweep", file.c_str(), "--out", out.c_str(), "--resume",
            "--quiet", nullptr);
    ::_exit(127);
  }
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Cell count_cell(const std::string& name, std::uint64_t hits, std::uint64_t n) {
  const auto value = static_cast<double>(hits);
  return {name, value, {value, value}, at_least(static_cast<double>(n)), n, "", Judgement::point};
}

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool reported(const fs::path& folder) {
  try {
    TrialStore::read(folder);
  } catch (const Error&) {
    return true;
  }
  return false;
}

/// Whether the rows, read without any verification, differ from `rows`.
bool rows_changed(const fs::path& folder, const std::string& rows) {
  try {
    return all_rows(folder) != rows;
  } catch (const Error&) {
    return true;
  }
}

void run_to(const fs::path& folder, const SweepSpec& spec, const Shard& shard,
            const SweepRunOptions& options) {
  TrialStore store = TrialStore::create(folder, spec, shard);
  store.begin_run(experiments::this_run());
  run_sweep(store, options);
}

}  // namespace

void run_killed_sweeps(const Options& options, const Report& report) {
  const std::uint64_t kills = options.trials_or(20);
  const ScratchFolder scratch;
  const fs::path file = sweep_file(scratch, 250), whole = scratch.path() / "whole";
  const auto start = std::chrono::steady_clock::now();
  if (wait_for(start_sweep(file, whole)) != 0) throw input_error("the undisturbed sweep failed");
  const double whole_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string rows = comparable_rows(whole);
  RandomStream random({options.seed, 60, 0, 0, Purpose::experiment});
  std::uint64_t equal = 0, killed = 0;
  for (std::uint64_t k = 0; k < kills; ++k) {
    const fs::path out = scratch.path() / fmt::format("killed-{}", k);
    const pid_t child = start_sweep(file, out);
    std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform() * whole_s));
    ::kill(child, SIGKILL);
    killed += wait_for(child) == 128 + SIGKILL ? 1 : 0;
    const bool resumed = wait_for(start_sweep(file, out)) == 0;
    equal += resumed && comparable_rows(out) == rows ? 1 : 0;
    fs::remove_all(out);
  }
  report(count_cell("killed with -9 and resumed: rows as undisturbed", equal, kills));
  Cell in_time = count_cell("  of them killed before they had ended", killed, kills);
  in_time.judgement = Judgement::shown;
  report(in_time);
}

void run_damaged_stores(const Options& options, const Report& report) {
  const std::uint64_t tries = options.trials_or(200), flips = tries * 3 / 4;
  const ScratchFolder scratch;
  const fs::path good = scratch.path() / "good", bad = scratch.path() / "bad";
  run_to(good, experiments::load_sweep(sweep_file(scratch, 60), false), {}, {});
  const std::string bytes = read_bytes(good / TrialStore::file_name);
  const std::string rows = all_rows(good);
  fs::create_directory(bad);
  const fs::path file = bad / TrialStore::file_name;
  RandomStream random({options.seed, 61, 0, 0, Purpose::experiment});
  std::uint64_t flipped = 0, found = 0, elsewhere = 0;
  while (flipped < flips) {
    std::string damaged = bytes;
    const std::size_t at = random.below(bytes.size());
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1 + random.below(255)));
    std::ofstream(file, std::ios::binary) << damaged;
    if (!rows_changed(bad, rows)) {
      ++elsewhere;
      continue;
    }
    ++flipped;
    found += reported(bad) ? 1 : 0;
  }
  report(count_cell("flipped bytes in rows reported", found, flips));
  Cell others = count_cell("  flips elsewhere in the file (free space, pages' own data)", elsewhere,
                           elsewhere);
  others.judgement = Judgement::shown;
  report(others);
  found = 0;
  for (std::uint64_t k = flips; k < tries; ++k) {
    std::ofstream(file, std::ios::binary) << bytes.substr(0, random.below(bytes.size()));
    found += reported(bad) ? 1 : 0;
  }
  report(count_cell("truncated stores reported", found, tries - flips));
  fs::remove(file);
}

void run_orders(const Options& options, const Report& report) {
  const ScratchFolder scratch;
  const SweepSpec spec = experiments::load_sweep(sweep_file(scratch, options.trials_or(60)), false);
  run_to(scratch.path() / "whole", spec, {}, {});
  const std::string rows = comparable_rows(scratch.path() / "whole");
  std::uint64_t equal = 0;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const fs::path out = scratch.path() / fmt::format("threads-{}", threads);
    run_to(out, spec, {}, {});
    equal += comparable_rows(out) == rows ? 1 : 0;
  }
  run_to(scratch.path() / "reversed", spec, {}, {.reversed = true});
  equal += comparable_rows(scratch.path() / "reversed") == rows ? 1 : 0;
  std::vector<fs::path> shards;
  for (std::uint64_t k = 1; k <= 3; ++k) {
    shards.push_back(scratch.path() / fmt::format("shard-{}", k));
    run_to(shards.back(), spec, {k, 3}, {});
  }
  experiments::merge_stores(shards, scratch.path() / "merged");
  equal += comparable_rows(scratch.path() / "merged") == rows ? 1 : 0;
  report(count_cell("1 thread, 2 threads, reversed cells, 3 shards merged: equal rows", equal, 4));
}

}  // namespace alea::acceptance
