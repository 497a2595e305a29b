#pragma once

#include "experiments/engine/sweep_experiment.hpp"

namespace alea::experiments::exactness {

/// The experiment `kernel`: the decisions and the corner of a die's three facets in three kernels,
/// held against the exact one.
SweepExperiment kernel_sweep();

}  // namespace alea::experiments::exactness
