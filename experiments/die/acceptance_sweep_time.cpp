#include <algorithm>
#include <ctime>

#include "alea/core/parallel.hpp"
#include "experiments/engine/scratch_folder.hpp"
#include "experiments/engine/sweep_acceptance.hpp"
#include "experiments/engine/sweep_run.hpp"

namespace alea::acceptance {
namespace {

using experiments::SweepSpec;
using experiments::TrialStore;

/// CPU time of the whole process, all threads.
double process_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct SweepTimes {
  double run_s = 0;      ///< CPU time of the run, the store's part included
  double rows_s = 0;     ///< of the rows' own durations, summed
  double least_s = 1e9;  ///< of one row
  std::uint64_t trials = 0;
};

SweepTimes time_sweep(const SweepSpec& spec) {
  const experiments::ScratchFolder scratch;
  SweepTimes times;
  {
    TrialStore store = TrialStore::create(scratch.path() / "sweep", spec, {});
    const double start = process_s();
    store.begin_run(experiments::this_run());
    run_sweep(store, {});
    times.run_s = process_s() - start;
  }
  TrialStore store = TrialStore::read(scratch.path() / "sweep");
  experiments::Statement rows(store.database(), "SELECT duration_s FROM trials");
  while (rows.next()) {
    times.rows_s += rows.real(0);
    times.least_s = std::min(times.least_s, rows.real(0));
  }
  times.trials = spec.units();
  return times;
}

/// CPU time of what a sweep computes once for each cell: bounds.
double cells_s(const SweepSpec& spec) {
  const double start = process_s();
  for (std::uint64_t cell = 0; cell < spec.cells(); ++cell)
    experiments::sweep_experiment(spec.experiment)
        .make_cell(spec.settings(cell), spec.estimators, spec.seed);
  return process_s() - start;
}

}  // namespace

void run_trial_times(const Options& options, const Report& report) {
  const std::uint64_t trials = options.trials_or(60);
  const ThreadLimit one(1);
  const auto number = [&](const char* name, double value, double least, const Limit& limit,
                          std::uint64_t n, const char* unit) {
    report({name, value, {least, value}, limit, n, unit, Judgement::point});
  };
  const SweepSpec alone = committed_sweep("range_noise", trials, {"closed_form"});
  const SweepTimes trial = time_sweep(alone);
  const double mean_ms = 1e3 * trial.rows_s / static_cast<double>(trial.trials);
  number("a trial of two scans of 20,000 points, closed form, CPU time, least and mean", mean_ms,
         1e3 * trial.least_s, at_most(25), trial.trials, "ms");
  const double overhead = 100 * (trial.run_s - trial.rows_s - cells_s(alone)) / trial.run_s;
  number("engine: CPU time beside trials and cells' bounds", overhead, overhead, at_most(2),
         trial.trials, "%");
  const SweepTimes all = time_sweep(committed_sweep("range_noise", trials, {}));
  const double minutes = all.run_s / static_cast<double>(all.trials) * 10'000 / 2 / 60;
  number("10,000 trials of the noise sweep, its five estimators, on two cores", minutes, minutes,
         at_most(3), all.trials, "min");
}

}  // namespace alea::acceptance
