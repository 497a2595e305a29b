#pragma once

#include "experiments/die/pip_trial.hpp"

namespace alea {

/// Pips scanned at 1 mrad, a few milliseconds a trial.
inline die::PipTrialOptions quick_pips() {
  die::PipTrialOptions options;
  options.step_rad = 1e-3;
  return options;
}

}  // namespace alea
