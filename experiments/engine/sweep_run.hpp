#pragma once

#include <atomic>
#include <cstdint>

#include "alea/core/progress.hpp"
#include "experiments/engine/trial_store.hpp"

namespace alea::experiments {

struct SweepRunOptions {
  bool reversed = false;                    ///< last cell first; the rows are the same
  const std::atomic<bool>* stop = nullptr;  ///< set: no further trial begins
  double commit_interval_s = 1;             ///< how much work a crash may cost
  ProgressCallback progress;
};

struct SweepRunSummary {
  std::uint64_t before = 0;  ///< trials that the store had
  std::uint64_t added = 0;
  bool interrupted = false;
  double duration_s = 0;
};

/// Runs the trials of the store's shard that it lacks, side by side on all threads, each of them
/// whole on one thread, and writes their rows. Trials go round the cells, so that an unfinished
/// sweep has about as many of each. Throws Error(input) where the store cannot be written.
SweepRunSummary run_sweep(TrialStore& store, const SweepRunOptions& options);

/// The machine's name, threads and the program's version and commit, and the time.
StoreRun this_run();

}  // namespace alea::experiments
