#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/die/acceptance.hpp"
#include "experiments/die/adjustment_trial.hpp"
#include "experiments/engine/sample_mean.hpp"

namespace alea::acceptance {
namespace {

using namespace experiments::die;  // NOLINT(google-build-using-namespace)

constexpr std::uint64_t adjustment_trials = 10000;

/// The numbers of one method over the trials that were not refused.
struct Sample {
  std::vector<double> rotation, translation, nees, inside, chi_square_share;
  std::array<std::vector<double>, 6> error;
  std::size_t refused = 0;
};

Sample sample_of(const std::vector<AdjustmentTrial>& trials, std::size_t method) {
  Sample sample;
  for (const AdjustmentTrial& trial : trials) {
    const PairError& e = trial.of_method[method];
    if (e.refused) {
      ++sample.refused;
      continue;
    }
    sample.rotation.push_back(e.error.head<3>().squaredNorm());
    sample.translation.push_back(e.error.tail<3>().squaredNorm());
    sample.nees.push_back(e.nees / 6);
    sample.inside.push_back(e.nees <= chi_square_95_of_six ? 1 : 0);
    if (e.freedom > 0) sample.chi_square_share.push_back(e.chi_square / e.freedom);
    for (int k = 0; k < 6; ++k) sample.error[static_cast<std::size_t>(k)].push_back(e.error[k]);
  }
  return sample;
}

std::array<std::vector<double>, 2> bounds_of(const std::vector<AdjustmentTrial>& trials,
                                             bool shape_known) {
  std::array<std::vector<double>, 2> squares;
  for (const AdjustmentTrial& trial : trials) {
    const auto& bound = shape_known ? trial.known_bound : trial.free_bound;
    for (std::size_t k = 0; k < 2; ++k) squares[k].push_back(bound[k]);
  }
  return squares;
}

void report_method(const std::string& name, const std::vector<AdjustmentTrial>& trials,
                   std::size_t method, std::vector<double>& bias_probabilities,
                   const Report& report) {
  const Sample sample = sample_of(trials, method);
  const bool known = pair_methods[method] == PairMethod::adjusted_known_shape;
  const auto bound = bounds_of(trials, known);
  report(
      rms_over_bound_cell(name + "rotation / bound", sample.rotation, bound[0], within(1, 0.05)));
  report(rms_over_bound_cell(name + "translation / bound", sample.translation, bound[1],
                             within(1, 0.05)));
  report(mean_cell(name + "NEES / 6", sample.nees, within(1, 0.05)));
  report(mean_cell(name + "inside the 95 % region", sample.inside, within(0.95, 0.015)));
  Cell closure = mean_cell(name + "chi-square / freedom", sample.chi_square_share, within(1, 0.1));
  closure.judgement = Judgement::shown;
  report(closure);
  report({name + "refused",
          static_cast<double>(sample.refused),
          {0, 0},
          at_most(0),
          trials.size(),
          "",
          Judgement::point});
  for (const auto& component : sample.error)
    bias_probabilities.push_back(probability_of_zero(mean_of(component)));
}

}  // namespace

void run_adjustment_topic(const Options& options, const Report& all_cells) {
  const Report report = [&](Cell cell) {
    if (cell.judgement == Judgement::interval)
      cell.judgement = options.judgement(adjustment_trials);
    all_cells(cell);
  };
  std::vector<double> bias_probabilities;
  for (const auto& [edge_m, range_m, step_rad] : std::vector<std::array<double, 3>>{
           {.5, 6, 1e-3}, {.5, 12, .5e-3}, {.3, 6, .5e-3}, {.5, 3, 2e-3}}) {
    EfficiencyCase setting;
    setting.edge_m = edge_m;
    setting.range_m = range_m;
    setting.step_rad = step_rad;
    const auto trials =
        run_adjustment_trials(setting, options.seed, options.trials_or(adjustment_trials));
    for (std::size_t method = 0; method < pair_methods.size(); ++method)
      report_method(fmt::format("{:g} m, {:g} m, {:g} mrad, {}: ", edge_m, range_m, step_rad * 1e3,
                                to_string(pair_methods[method])),
                    trials, method, bias_probabilities, report);
  }
  const double holm = least_by_holm(bias_probabilities);
  report({"bias of any error component, probability after Holm",
          holm,
          {holm, holm},
          at_least(0.05),
          bias_probabilities.size(),
          "",
          Judgement::point});
}

}  // namespace alea::acceptance
