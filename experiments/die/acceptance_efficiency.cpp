#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "alea/core/angle.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/efficiency_trial.hpp"
#include "experiments/engine/sample_mean.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::EfficiencyCase;
using experiments::die::EfficiencyTrial;
using experiments::die::run_efficiency;

constexpr std::uint64_t efficiency_trials = 10000;

/// Mean of a number over the trials that were not refused, with its standard error.
struct Mean {
  double value = 0;
  double standard_error = 0;
  std::size_t n = 0;
};

Mean mean_of(const std::vector<EfficiencyTrial>& trials,
             const std::function<double(const EfficiencyTrial&)>& number) {
  Mean mean;
  double square = 0;
  for (const EfficiencyTrial& trial : trials) {
    if (trial.refused) continue;
    ++mean.n;
    mean.value += number(trial);
  }
  const auto n = static_cast<double>(mean.n);
  mean.value /= n;
  for (const EfficiencyTrial& trial : trials)
    if (!trial.refused) square += std::pow(number(trial) - mean.value, 2);
  mean.standard_error = std::sqrt(square / (n - 1) / n);
  return mean;
}

Cell cell_of(const std::string& name, double value, const Interval& interval, const Limit& limit,
             std::size_t n, const std::string& unit = "") {
  return {name, value, interval, limit, n, unit, Judgement::interval};
}

/// RMS over the bound; the interval from the spread of the squares.
Cell ratio_cell(const std::string& name, const std::vector<EfficiencyTrial>& trials,
                double EfficiencyTrial::*error, double bound, const Limit& limit) {
  const Mean square =
      mean_of(trials, [&](const EfficiencyTrial& t) { return t.*error * t.*error; });
  const auto ratio = [&](double mean_square) { return std::sqrt(mean_square) / bound; };
  return cell_of(name, ratio(square.value),
                 {ratio(std::max(0.0, square.value - 1.96 * square.standard_error)),
                  ratio(square.value + 1.96 * square.standard_error)},
                 limit, square.n);
}

Cell efficiency_cell(const std::string& name, const Mean& mean, const Limit& limit, double unit = 1,
                     const std::string& unit_name = "") {
  const double half = 1.96 * mean.standard_error;
  return cell_of(name, mean.value / unit, {(mean.value - half) / unit, (mean.value + half) / unit},
                 limit, mean.n, unit_name);
}

PoseAccuracy bound_of(const EfficiencyCase& setting) {
  DieBoundCase geometry;
  geometry.edge_m = setting.edge_m;
  geometry.range_m = setting.range_m;
  geometry.step_rad = setting.step_rad;
  geometry.shape_known = false;
  return die_bound(geometry);
}

void report_case(const EfficiencyCase& setting, const Options& options, const Report& all_cells) {
  const auto trials = run_efficiency(setting, options.seed, options.trials_or(efficiency_trials));
  const Report report = [&](Cell cell) {
    if (cell.judgement == Judgement::interval)
      cell.judgement = options.judgement(efficiency_trials);
    all_cells(cell);
  };
  const PoseAccuracy bound = bound_of(setting);
  const std::string name = fmt::format("{:g} m, {:g} m, {:g} mrad: ", setting.edge_m,
                                       setting.range_m, setting.step_rad * 1e3);
  report(ratio_cell(name + "rotation / L", trials, &EfficiencyTrial::rotation_rad,
                    bound.rotation_rad, at_most(1.10)));
  report(ratio_cell(name + "translation / L", trials, &EfficiencyTrial::translation_m,
                    bound.translation_m, at_most(1.20)));
  report(efficiency_cell(name + "NEES / 6",
                         mean_of(trials, [](const EfficiencyTrial& t) { return t.nees / 6; }),
                         within(1, 0.07)));
  report(efficiency_cell(
      name + "inside the 95 % ellipsoid",
      mean_of(trials,
              [&](const EfficiencyTrial& t) { return t.nees <= chi_square_95_of_six ? 1.0 : 0.0; }),
      within(0.95, 0.015)));
  Cell closure = efficiency_cell(
      name + "misclosure chi-square, 1 degree of freedom",
      mean_of(trials, [](const EfficiencyTrial& t) { return t.misclosure_chi_square; }),
      within(1, 0.1));
  closure.judgement = Judgement::shown;
  report(closure);
  Cell refused = cell_of(name + "refused", 0, {0, 0}, at_most(0), trials.size());
  for (const EfficiencyTrial& trial : trials) refused.value += trial.refused ? 1 : 0;
  refused.judgement = Judgement::point;
  report(refused);
}

}  // namespace

void run_efficiency_topic(const Options& options, const Report& report) {
  const std::vector<std::array<double, 3>> cases{
      {.5, 6, 1e-3}, {.5, 12, .5e-3}, {.3, 6, .5e-3}, {.5, 3, 2e-3}};
  for (const auto& [edge_m, range_m, step_rad] : cases) {
    EfficiencyCase setting;
    setting.edge_m = edge_m;
    setting.range_m = range_m;
    setting.step_rad = step_rad;
    report_case(setting, options, report);
  }
}

void run_mixed_domains(const Options& options, const Report& report) {
  EfficiencyCase setting;
  setting.step_rad = 3e-4;
  setting.fit = FitMethod::orthogonal;
  const auto trials = run_efficiency(setting, options.seed, options.trials_or(300));
  const Mean tilt = mean_of(trials, [](const EfficiencyTrial& t) { return t.top_tilt_rad; });
  Cell bias = efficiency_cell("ray selection, orthogonal fit: tilt of the upper facet", tilt,
                              within(0, 1), deg, "deg");
  const double size = std::abs(bias.value), half = (bias.interval.high - bias.interval.low) / 2;
  bias.value = size;
  bias.interval = {size - half, size + half};
  bias.limit = within(0.0217, 0.15 * 0.0217);
  report(bias);
  report(ratio_cell("ray selection, orthogonal fit: rotation / L", trials,
                    &EfficiencyTrial::rotation_rad, bound_of(setting).rotation_rad, at_least(3)));
}

}  // namespace alea::acceptance
