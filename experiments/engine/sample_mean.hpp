#pragma once

#include <string>
#include <vector>

#include "experiments/engine/acceptance.hpp"

namespace alea::acceptance {

/// Mean of independent numbers with its standard error.
struct SampleMean {
  double value = 0;
  double standard_error = 0;
  std::size_t n = 0;
};

/// What a squared error of six unknowns, weighted by its covariance, exceeds in 5 % of all trials.
inline constexpr double chi_square_95_of_six = 12.5916;

SampleMean mean_of(const std::vector<double>& numbers);

/// A mean with its 95 % interval.
Cell mean_cell(const std::string& name, const std::vector<double>& numbers, const Limit& limit);

/// Root of the mean of `squares` over the root of the mean of `squared_bounds`, with the 95 %
/// interval that the spread of the squares gives.
Cell rms_over_bound_cell(const std::string& name, const std::vector<double>& squares,
                         const std::vector<double>& squared_bounds, const Limit& limit);

/// Two-sided probability of a mean as far from zero as this one, by the normal distribution.
double probability_of_zero(const SampleMean& mean);

/// The smallest of the probabilities after Holm's correction (1979) for their number: below 0.05
/// some of them is not chance.
double least_by_holm(const std::vector<double>& probabilities);

}  // namespace alea::acceptance
