#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/engine/acceptance.hpp"
#include "experiments/engine/sweep_spec.hpp"

namespace alea::acceptance {

/// The topics of the sweeps, in the order in which they run.
std::vector<Topic> sweep_topics();

/// A sweep of experiments/die/sweeps at its full grid, with as many trials a cell as asked for and
/// these estimators (none: its own).
experiments::SweepSpec committed_sweep(const std::string& name, std::uint64_t trials,
                                       const std::vector<std::string>& estimators);

/// Issue sweeps, line 1: kill -9 at 20 random moments, then --resume.
void run_killed_sweeps(const Options& options, const Report& report);
/// Issue sweeps, line 1: a flipped byte in a row's values, a truncated store: 200 tries.
void run_damaged_stores(const Options& options, const Report& report);
/// Issue sweeps, line 2: threads, shards and reversed order give equal rows.
void run_orders(const Options& options, const Report& report);
/// Issue sweeps, line 3: CPU time of a trial, of 10,000 of them, and of the engine.
void run_trial_times(const Options& options, const Report& report);
/// Issue sweeps, line 4: slopes of the errors and bounds in noise, step and range.
void run_slopes(const Options& options, const Report& report);
/// Issue sweeps, line 4: range at which the displacement on a ring of 10 m reaches 2.5 mm.
void run_sweep_ranges(const Options& options, const Report& report);
/// Issue sweeps, line 4: medians of the leak curves.
void run_leak_curves(const Options& options, const Report& report);

}  // namespace alea::acceptance
