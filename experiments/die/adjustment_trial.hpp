#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "experiments/die/efficiency_trial.hpp"

namespace alea::experiments::die {

/// How a pair of scans is registered.
enum class PairMethod { closed_form, adjusted_known_shape, adjusted_free_shape };
inline constexpr std::array<PairMethod, 3> pair_methods{
    PairMethod::closed_form, PairMethod::adjusted_known_shape, PairMethod::adjusted_free_shape};
const char* to_string(PairMethod method);

/// Error of one method in one trial, about the die's centre in the master frame.
struct PairError {
  bool refused = false;
  Vector6d error = Vector6d::Zero();  ///< left difference: rotation (rad), translation (m)
  double nees = 0;                    ///< error' covariance^-1 error, six degrees of freedom
  double chi_square = 0;              ///< of the adjustment
  int freedom = 0;
  bool suspect = false;      ///< some facet was flagged
  double points_factor = 1;  ///< variance components: within the facets (mean of both scans) ...
  double facets_factor = 1;  ///< ... and between the scans
};

struct AdjustmentTrial {
  std::array<PairError, pair_methods.size()> of_method;  ///< in the order of pair_methods
  /// Squared Cramer-Rao bounds of this trial's die, summed over three axes: rotation (rad^2) and
  /// displacement of the centre (m^2), with known and with free shape.
  std::array<double, 2> known_bound{}, free_bound{};
};

AdjustmentTrial run_adjustment_trial(const EfficiencyCase& setting, std::uint64_t seed,
                                     std::uint64_t trial);

std::vector<AdjustmentTrial> run_adjustment_trials(const EfficiencyCase& setting,
                                                   std::uint64_t seed, std::size_t trials);

}  // namespace alea::experiments::die
