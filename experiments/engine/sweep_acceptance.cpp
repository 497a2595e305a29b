#include "experiments/engine/sweep_acceptance.hpp"

namespace alea::acceptance {

std::vector<Topic> sweep_topics() {
  return {
      {"sweeps", "kill", "kill -9 at random moments, then --resume: equal rows", run_killed_sweeps},
      {"sweeps", "damage", "flipped bytes and truncated stores are reported", run_damaged_stores},
      {"sweeps", "order", "threads, shards and reversed order: equal rows", run_orders},
      {"sweeps", "time", "CPU time of a trial and of the engine", run_trial_times},
      {"sweeps", "slopes", "errors and bounds against noise, step and range", run_slopes},
      {"sweeps", "ranges", "effective ranges from the rows of a sweep", run_sweep_ranges},
      {"sweeps", "leak", "leak curves of the frame rules", run_leak_curves},
  };
}

}  // namespace alea::acceptance
