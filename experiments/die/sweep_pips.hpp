#pragma once

#include "experiments/engine/sweep_experiment.hpp"

namespace alea::experiments::die {

/// The experiment `pips`: one scan of a die, its pips read by the counting chain and by likelihood.
SweepExperiment pip_sweep();

}  // namespace alea::experiments::die
