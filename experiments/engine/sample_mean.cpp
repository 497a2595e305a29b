#include "experiments/engine/sample_mean.hpp"

#include <algorithm>
#include <cmath>

namespace alea::acceptance {

SampleMean mean_of(const std::vector<double>& numbers) {
  SampleMean mean;
  mean.n = numbers.size();
  const auto n = static_cast<double>(mean.n);
  for (const double number : numbers) mean.value += number / n;
  double spread = 0;
  for (const double number : numbers) spread += std::pow(number - mean.value, 2);
  mean.standard_error = std::sqrt(spread / (n - 1) / n);
  return mean;
}

Cell mean_cell(const std::string& name, const std::vector<double>& numbers, const Limit& limit) {
  const SampleMean mean = mean_of(numbers);
  const double half = 1.96 * mean.standard_error;
  return {name, mean.value,         {mean.value - half, mean.value + half}, limit, mean.n,
          "",   Judgement::interval};
}

Cell rms_over_bound_cell(const std::string& name, const std::vector<double>& squares,
                         const std::vector<double>& squared_bounds, const Limit& limit) {
  const SampleMean square = mean_of(squares);
  const double bound = mean_of(squared_bounds).value, half = 1.96 * square.standard_error;
  return {name,
          std::sqrt(square.value / bound),
          {std::sqrt(std::max(0.0, square.value - half) / bound),
           std::sqrt((square.value + half) / bound)},
          limit,
          square.n,
          "",
          Judgement::interval};
}

double probability_of_zero(const SampleMean& mean) {
  return std::erfc(std::abs(mean.value) / mean.standard_error / std::sqrt(2.0));
}

double least_by_holm(const std::vector<double>& probabilities) {
  // Holm's smallest adjusted probability is Bonferroni's.
  const double least = *std::min_element(probabilities.begin(), probabilities.end());
  return std::min(1.0, least * static_cast<double>(probabilities.size()));
}

}  // namespace alea::acceptance
