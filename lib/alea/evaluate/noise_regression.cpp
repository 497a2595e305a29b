#include "alea/evaluate/noise_regression.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "alea/core/median.hpp"

namespace alea {
namespace {

constexpr double rejected_beyond = 4;
constexpr int rounds = 25;
constexpr double singular = 1e-9;  // of the scaled normal matrix

Eigen::Vector4d regressors(const NoiseTile& tile) {
  return {tile.cos2, tile.range2_cos2_m2, tile.sin2, tile.range2_sin2_m2};
}

double freedoms(const NoiseTile& tile) {
  return static_cast<double>(tile.points) - 3;
}

/// State of the iteration. `theta`: variances of a unit of each regressor.
struct Fit {
  Eigen::Vector4d theta = Eigen::Vector4d::Zero();
  std::array<bool, 4> free{};
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  std::vector<bool> used;
  double overdispersion = 1;
  double known_m2 = 0;  ///< variance of no term
  double floor_m2 = 0;  ///< least variance that a weight believes in
};

/// Departure of a tile's variance from `expected` in standard deviations of chance, nearly normal
/// on the cube-root scale.
double departure(const NoiseTile& tile, double expected) {
  const double part = 2 / (9 * freedoms(tile));
  return (std::cbrt(tile.variance_m2 / expected) - (1 - part)) / std::sqrt(part);
}

double expected_variance(const NoiseTile& tile, const Fit& fit) {
  return std::max(regressors(tile).dot(fit.theta) + fit.known_m2, fit.floor_m2);
}

void select(const std::vector<NoiseTile>& tiles, Fit& fit) {
  std::vector<double> departures, sizes;
  for (const NoiseTile& tile : tiles)
    departures.push_back(departure(tile, expected_variance(tile, fit)));
  const double middle = median(departures);
  for (const double z : departures) sizes.push_back(std::abs(z - middle));
  const double scale = std::max(1.0, 1.4826 * median(sizes));
  fit.overdispersion = scale * scale;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    fit.used[i] = std::abs(departures[i] - middle) <= rejected_beyond * scale;
}

void accumulate(const std::vector<NoiseTile>& tiles, Fit& fit) {
  const Eigen::Vector4d fixed_theta = fit.theta;
  fit.normal.setZero();
  fit.right.setZero();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (!fit.used[i]) continue;
    const Eigen::Vector4d x = regressors(tiles[i]);
    double known = fit.known_m2;
    for (int k = 0; k < 4; ++k)
      if (!fit.free[k]) known += x[k] * fixed_theta[k];
    const double expected = expected_variance(tiles[i], fit);
    const double weight = freedoms(tiles[i]) / (2 * expected * expected);
    fit.normal += weight * x * x.transpose();
    fit.right += weight * x * (tiles[i].variance_m2 - known);
  }
}

/// Least squares over a subset of the terms; NaN where the subset is not determined.
Eigen::Vector4d solve_subset(const Fit& fit, unsigned subset) {
  std::vector<int> at;
  for (int k = 0; k < 4; ++k)
    if ((subset >> k & 1U) != 0) at.push_back(k);
  Eigen::Vector4d out = Eigen::Vector4d::Zero();
  if (at.empty()) return out;
  const Eigen::MatrixXd normal = fit.normal(at, at);
  const Eigen::VectorXd unit = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = unit.asDiagonal() * normal * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(scaled);
  if (!(spectrum.eigenvalues()[0] > singular))
    return Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::VectorXd right = fit.right(at);
  const Eigen::VectorXd solution =
      unit.asDiagonal() * scaled.ldlt().solve((unit.asDiagonal() * right).eval());
  for (std::size_t k = 0; k < at.size(); ++k) out[at[k]] = solution[static_cast<Eigen::Index>(k)];
  return out;
}

/// The best solution without a negative term, over all subsets of the free ones.
void solve_not_negative(Fit& fit) {
  double best = std::numeric_limits<double>::infinity();
  Eigen::Vector4d chosen = Eigen::Vector4d::Zero();
  unsigned all = 0;
  for (int k = 0; k < 4; ++k) all |= fit.free[k] ? 1U << k : 0U;
  for (unsigned subset = 0; subset < 16; ++subset) {
    if ((subset & ~all) != 0) continue;
    const Eigen::Vector4d theta = solve_subset(fit, subset);
    if (!theta.allFinite() || theta.minCoeff() < 0) continue;
    const double cost = theta.dot(fit.normal * theta) - 2 * theta.dot(fit.right);
    if (cost < best) best = cost, chosen = theta;
  }
  for (int k = 0; k < 4; ++k)
    if (fit.free[k]) fit.theta[k] = chosen[k];
}

/// Standard errors of the free terms' variances, infinite where they cannot be told apart.
Eigen::Vector4d standard_errors(const Fit& fit) {
  std::vector<int> at;
  for (int k = 0; k < 4; ++k)
    if (fit.free[k]) at.push_back(k);
  Eigen::Vector4d out = Eigen::Vector4d::Zero();
  if (at.empty()) return out;
  const Eigen::MatrixXd normal = fit.normal(at, at);
  const Eigen::VectorXd unit = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(unit.asDiagonal() * normal *
                                                                unit.asDiagonal());
  for (std::size_t k = 0; k < at.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    double variance = 0;
    for (Eigen::Index m = 0; m < normal.rows(); ++m) {
      const double part = std::pow(spectrum.eigenvectors()(row, m), 2);
      variance += part > 1e-12 ? part / std::max(spectrum.eigenvalues()[m], 1e-300) : 0;
    }
    out[at[k]] = unit[row] * std::sqrt(variance * fit.overdispersion);
  }
  return out;
}

/// Squared ranges of the tiles that took part: the median and the 95th percentile.
std::array<double, 2> typical_ranges2(const std::vector<NoiseTile>& tiles, const Fit& fit) {
  std::vector<double> ranges2;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if (fit.used[i]) ranges2.push_back(tiles[i].range2_cos2_m2 + tiles[i].range2_sin2_m2);
  if (ranges2.empty()) return {0, 0};
  std::sort(ranges2.begin(), ranges2.end());
  return {ranges2[ranges2.size() / 2],
          ranges2[static_cast<std::size_t>(0.95 * (static_cast<double>(ranges2.size()) - 1))]};
}

/// Where a term matters most in use: range terms straight on, the others at 60 deg, what grows with
/// the range far away.
double share_where_it_matters(int term, const Eigen::Vector4d& errors, const Fit& fit,
                              const std::array<double, 2>& ranges2) {
  const double cos2 = term < 2 ? 1.0 : 0.25, sin2 = 1 - cos2;
  const double range2 = ranges2[term % 2];
  const Eigen::Vector4d x(cos2, range2 * cos2, sin2, range2 * sin2);
  const double whole = std::max(fit.theta.dot(x) + fit.known_m2, fit.floor_m2);
  return errors[term] * x[term] / whole;
}

Fit iterate(const std::vector<NoiseTile>& tiles, Fit fit) {
  // The first weights are those of a scatter that is the same everywhere.
  const double floor_m2 = 1e-4 * fit.floor_m2;
  accumulate(tiles, fit);
  solve_not_negative(fit);
  fit.floor_m2 = floor_m2;
  for (int round = 0; round < rounds; ++round) {
    select(tiles, fit);
    accumulate(tiles, fit);
    solve_not_negative(fit);
  }
  return fit;
}

}  // namespace

NoiseRegression regress_noise(const std::vector<NoiseTile>& tiles,
                              const std::array<std::optional<double>, 4>& fixed,
                              double known_variance_m2) {
  Fit start;
  start.used.assign(tiles.size(), true);
  start.known_m2 = known_variance_m2;
  std::vector<double> variances;
  for (const NoiseTile& tile : tiles) variances.push_back(tile.variance_m2);
  start.floor_m2 = std::max(median(variances), std::numeric_limits<double>::min());
  for (int k = 0; k < 4; ++k) {
    start.free[k] = !fixed[k];
    start.theta[k] = fixed[k].value_or(0);
  }
  const Fit fit = iterate(tiles, start);
  NoiseRegression out{fit.theta, standard_errors(fit), fit.used, fit.overdispersion, {}};
  const std::array<double, 2> ranges2 = typical_ranges2(tiles, fit);
  for (int k = 0; k < 4; ++k)
    out.share[k] = share_where_it_matters(k, out.standard_error, fit, ranges2);
  return out;
}

}  // namespace alea
