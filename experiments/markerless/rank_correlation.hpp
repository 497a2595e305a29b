#pragma once

#include <vector>

namespace alea::experiments::markerless {

struct RankCorrelation {
  double rho = 0;
  double p_value = 1;  ///< two-sided
};

/// Spearman's rank correlation of two samples of equal length (mean ranks for ties). The p-value
/// counts all permutations up to 9 values and uses Student's t beyond.
RankCorrelation rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace alea::experiments::markerless
