#include <fmt/format.h>

#include <string>
#include <vector>

#include "experiments/die/acceptance.hpp"
#include "experiments/die/adjustment_trial.hpp"
#include "experiments/engine/sample_mean.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::AdjustmentTrial;
using experiments::die::EfficiencyCase;
using experiments::die::pair_methods;
using experiments::die::PairError;

constexpr std::uint64_t misfit_trials = 2000;

/// Mean of a number over the trials, which is shown and not judged.
void show(const std::string& name, const std::vector<AdjustmentTrial>& trials, std::size_t method,
          double (*number)(const PairError&), const Report& report) {
  std::vector<double> numbers;
  for (const AdjustmentTrial& trial : trials)
    if (!trial.of_method[method].refused) numbers.push_back(number(trial.of_method[method]));
  Cell cell = mean_cell(name, numbers, {});
  cell.judgement = Judgement::shown;
  report(cell);
}

void report_setting(const std::string& what, const EfficiencyCase& setting, const Options& options,
                    const Report& report) {
  const auto trials = experiments::die::run_adjustment_trials(setting, options.seed,
                                                              options.trials_or(misfit_trials));
  for (std::size_t method = 1; method < pair_methods.size(); ++method) {
    const std::string name = fmt::format("{}, {}: ", what, to_string(pair_methods[method]));
    show(
        name + "inside the 95 % region", trials, method,
        [](const PairError& e) { return e.nees <= chi_square_95_of_six ? 1.0 : 0.0; }, report);
    show(
        name + "NEES / 6", trials, method, [](const PairError& e) { return e.nees / 6; }, report);
    show(
        name + "variance component, points", trials, method,
        [](const PairError& e) { return e.points_factor; }, report);
    show(
        name + "variance component, facets", trials, method,
        [](const PairError& e) { return e.facets_factor; }, report);
    show(
        name + "share with a suspect facet", trials, method,
        [](const PairError& e) { return e.suspect ? 1.0 : 0.0; }, report);
  }
}

}  // namespace

void run_misfit(const Options& options, const Report& report) {
  const EfficiencyCase plain;
  report_setting("model holds", plain, options, report);
  for (const double bow_m : {0.001, 0.005}) {
    EfficiencyCase warped = plain;
    warped.bow_m = bow_m;
    report_setting(fmt::format("facets bowed by {:g} mm", bow_m * 1e3), warped, options, report);
  }
  EfficiencyCase rounded = plain;
  rounded.edge_radius_m = 0.02;
  report_setting("edges rounded by 20 mm, trimmed as much", rounded, options, report);
  for (const double bias_m : {0.0001, 0.0005}) {
    EfficiencyCase biased = plain;
    biased.facet_bias_sd_m = bias_m;
    report_setting(fmt::format("range bias of {:g} mm sd, each facet and scan", bias_m * 1e3),
                   biased, options, report);
  }
}

}  // namespace alea::acceptance
