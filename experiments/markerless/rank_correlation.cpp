#include "experiments/markerless/rank_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace alea::experiments::markerless {
namespace {

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t last = i;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[i]]) ++last;
    for (std::size_t k = i; k <= last; ++k) ranks[order[k]] = static_cast<double>(i + last) / 2;
    i = last + 1;
  }
  return ranks;
}

double pearson(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

double permutation_p(const std::vector<double>& a, std::vector<double> b, double rho) {
  std::sort(b.begin(), b.end());
  std::size_t as_far = 0, all = 0;
  do {
    ++all;
    if (std::abs(pearson(a, b)) >= std::abs(rho) - 1e-12) ++as_far;
  } while (std::next_permutation(b.begin(), b.end()));
  return static_cast<double>(as_far) / static_cast<double>(all);
}

/// Two-sided tail of Student's t: the regularised incomplete beta function by Simpson's rule.
double student_p(double t, double degrees) {
  const double x0 = degrees / (degrees + t * t);
  // I_x0(degrees / 2, 1 / 2) with u = sin^2(angle) removes the singular end.
  const double end = std::asin(std::sqrt(x0));
  const auto f = [&](double angle) { return std::pow(std::sin(angle), degrees - 1); };
  const auto integral = [&](double high) {
    const int steps = 2000;
    double sum = f(0) + f(high);
    for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(high * i / steps);
    return sum * high / (3 * steps);
  };
  return integral(end) / integral(std::asin(1.0));
}

}  // namespace

RankCorrelation rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> of_a = ranks_of(a), of_b = ranks_of(b);
  const double rho = pearson(of_a, of_b);
  if (a.size() <= 9) return {rho, permutation_p(of_a, of_b, rho)};
  const double degrees = static_cast<double>(a.size()) - 2;
  return {rho, student_p(rho * std::sqrt(degrees / std::max(1e-300, 1 - rho * rho)), degrees)};
}

}  // namespace alea::experiments::markerless
