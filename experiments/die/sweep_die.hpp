#pragma once

#include <cstdint>

#include "experiments/engine/sweep_experiment.hpp"

namespace alea::experiments::die {

/// Names the random streams of the sweeps of the die; cells share them, so that they are compared
/// on the same trials.
inline constexpr std::uint32_t sweep_experiment_number = 40;

/// The experiment `die`: two simulated scans of a die, facets, transform by any of the estimators.
SweepExperiment die_sweep();

}  // namespace alea::experiments::die
