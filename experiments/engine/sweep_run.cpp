#include "experiments/engine/sweep_run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <malloc.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <mutex>

#include "alea/core/error.hpp"
#include "alea/core/version.hpp"
#include "experiments/engine/build_info.hpp"

namespace alea::experiments {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Cells are made when their first trial comes: a bound may take a while.
class Cells {
 public:
  explicit Cells(const SweepSpec& spec) : spec_(spec), made_(spec.cells()), cells_(spec.cells()) {}

  const SweepCell& at(std::uint64_t cell) {
    std::call_once(made_[cell], [&] {
      cells_[cell] = sweep_experiment(spec_.experiment)
                         .make_cell(spec_.settings(cell), spec_.estimators, spec_.seed);
    });
    return *cells_[cell];
  }

 private:
  const SweepSpec& spec_;
  std::vector<std::once_flag> made_;
  std::vector<std::unique_ptr<SweepCell>> cells_;
};

/// Takes rows from all threads and commits them now and then.
class Writer {
 public:
  Writer(TrialStore& store, const SweepRunOptions& options, std::uint64_t pending)
      : store_(store), options_(options), pending_(pending) {}

  void take(std::uint64_t cell, std::uint64_t trial, const std::vector<TrialRow>& rows) {
    const std::lock_guard lock(mutex_);
    store_.add(cell, trial, rows);
    ++added_;
    if (options_.progress) options_.progress(store_.spec().name, added_, pending_);
    if (seconds_since(last_) < options_.commit_interval_s) return;
    store_.commit(seconds_since(start_));
    last_ = Clock::now();
  }

  void finish() { store_.commit(seconds_since(start_)); }
  std::uint64_t added() const { return added_; }
  double duration_s() const { return seconds_since(start_); }

 private:
  TrialStore& store_;
  const SweepRunOptions& options_;
  std::uint64_t pending_;
  std::mutex mutex_;
  std::uint64_t added_ = 0;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// Clouds come and go with every trial: memory that goes back to the system each time would have to
/// be cleared again each time, a tenth of a trial's time.
void keep_memory() {
  constexpr int kept_bytes = 1 << 25;  // the most that glibc takes for the first
  ::mallopt(M_MMAP_THRESHOLD, kept_bytes);
  ::mallopt(M_TRIM_THRESHOLD, kept_bytes);
}

/// A trial whose settings or draws make no die is a result too.
std::vector<TrialRow> run_trial(const SweepSpec& spec, const SweepCell& cell, std::uint64_t trial) {
  try {
    return cell.run(trial);
  } catch (const Error&) {
    std::vector<TrialRow> rows;
    const std::size_t extra = sweep_experiment(spec.experiment).extra_columns.size();
    for (const std::string& estimator : spec.estimators) {
      rows.push_back({estimator});
      rows.back().extra.assign(extra, no_number);
      rows.back().verdict = "impossible";
    }
    return rows;
  }
}

}  // namespace

SweepRunSummary run_sweep(TrialStore& store, const SweepRunOptions& options) {
  keep_memory();
  const SweepSpec& spec = store.spec();
  const std::uint64_t cells = spec.cells(), units = spec.units();
  SweepRunSummary summary;
  summary.before = store.done_units();
  const std::uint64_t pending = store.shard().size(units) - summary.before;
  Cells made(spec);
  Writer writer(store, options, pending);
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  // An arena of one slot for each thread: what a trial runs in parallel stays on its thread.
  tbb::enumerable_thread_specific<tbb::task_arena> alone([] { return tbb::task_arena(1, 1); });
  // store.has() is read while commits of other trials set other bits, so it is asked beforehand.
  std::vector<std::uint64_t> order;
  order.reserve(pending);
  for (std::uint64_t step = 0; step < units; ++step) {
    const std::uint64_t trial = step / cells, turn = step % cells;
    const std::uint64_t cell = options.reversed ? cells - 1 - turn : turn;
    if (store.shard().has(cell * spec.trials + trial) && !store.has(cell, trial))
      order.push_back(cell * spec.trials + trial);
  }
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, order.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end() && !stopped(); ++i) {
          const std::uint64_t cell = order[i] / spec.trials, trial = order[i] % spec.trials;
          std::vector<TrialRow> rows;
          alone.local().execute([&] { rows = run_trial(spec, made.at(cell), trial); });
          writer.take(cell, trial, rows);
        }
      },
      tbb::simple_partitioner());
  writer.finish();
  summary.added = writer.added();
  summary.interrupted = summary.added < pending;
  summary.duration_s = writer.duration_s();
  return summary;
}

StoreRun this_run() {
  StoreRun run;
  run.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  run.version = version();
  run.git_commit = build_commit();
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) == 0) run.machine = name.data();
  run.threads = static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return run;
}

}  // namespace alea::experiments
