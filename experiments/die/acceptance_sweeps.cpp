#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "experiments/engine/build_info.hpp"
#include "experiments/engine/sweep_acceptance.hpp"

namespace alea::acceptance {
namespace {

using experiments::SweepSpec;
using experiments::TrialRow;

/// Rows by cell, trial and estimator.
using SweepRows = std::vector<std::vector<std::vector<TrialRow>>>;

SweepRows run_rows(const SweepSpec& spec) {
  const auto& experiment = experiments::sweep_experiment(spec.experiment);
  SweepRows rows(spec.cells());
  for (std::uint64_t cell = 0; cell < rows.size(); ++cell) {
    const auto made = experiment.make_cell(spec.settings(cell), spec.estimators, spec.seed);
    rows[cell].resize(spec.trials);
    parallel_chunks(spec.trials, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t trial = begin; trial < end; ++trial) rows[cell][trial] = made->run(trial);
    });
  }
  return rows;
}

double rms(const std::vector<std::vector<TrialRow>>& trials, std::size_t estimator,
           const std::function<double(const TrialRow&)>& number, std::size_t group = 0,
           std::size_t groups = 1) {
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t t = group; t < trials.size(); t += groups) {
    const TrialRow& row = trials[t][estimator];
    if (row.verdict != "registered") continue;
    sum += std::pow(number(row), 2);
    ++n;
  }
  return std::sqrt(sum / static_cast<double>(n));
}

/// Slope of log y over log x by least squares.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double mx = 0, my = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) mx += std::log(x[k]) / n, my += std::log(y[k]) / n;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += std::pow(std::log(x[k]) - mx, 2);
    xy += (std::log(x[k]) - mx) * (std::log(y[k]) - my);
  }
  return xy / xx;
}

struct Slope {
  std::string name;
  double low, high;  ///< of the axis
  std::vector<std::string> estimators;
  std::vector<Limit> limits;
};

void report_slope(const Slope& wanted, const Options& options, const Report& report) {
  constexpr std::uint64_t own_trials = 1000;
  constexpr std::size_t groups = 10;
  const std::uint64_t trials = options.trials_or(own_trials);
  SweepSpec spec = committed_sweep(wanted.name, trials, wanted.estimators);
  std::erase_if(spec.axes[0].values, [&](const experiments::SweepValue& value) {
    const double x = std::get<double>(value);
    return x < wanted.low || x > wanted.high;
  });
  const SweepRows rows = run_rows(spec);
  std::vector<double> x;
  for (const auto& value : spec.axes[0].values) x.push_back(std::get<double>(value));
  const auto slope = [&](std::size_t e, const std::function<double(const TrialRow&)>& number,
                         std::size_t group, std::size_t of) {
    std::vector<double> y;
    for (const auto& cell : rows) y.push_back(rms(cell, e, number, group, of));
    return slope_of(x, y);
  };
  const auto rotation = [](const TrialRow& row) { return row.rotation_error_rad; };
  const auto bound = [](const TrialRow& row) { return row.bound_rotation_rad; };
  for (std::size_t e = 0; e < wanted.estimators.size(); ++e) {
    const std::string what = fmt::format(
        "slope of rotation in {}, {:g} to {:g}: ", spec.axes[0].name, x.front(), x.back());
    const double of_bound = slope(e, bound, 0, 1);
    report({what + "bound of " + wanted.estimators[e],
            of_bound,
            {of_bound, of_bound},
            wanted.limits[e],
            1,
            "",
            Judgement::point});
    const double value = slope(e, rotation, 0, 1);
    double spread = 0, mean = 0;
    std::array<double, groups> parts{};
    for (std::size_t g = 0; g < groups; ++g)
      mean += (parts[g] = slope(e, rotation, g, groups)) / groups;
    for (const double part : parts) spread += std::pow(part - mean, 2);
    const double half = 2.262 * std::sqrt(spread / (groups - 1) / groups);  // Student, 9 freedoms
    report({what + wanted.estimators[e],
            value,
            {value - half, value + half},
            wanted.limits[e],
            trials,
            "",
            options.judgement(own_trials)});
  }
}

}  // namespace

experiments::SweepSpec committed_sweep(const std::string& name, std::uint64_t trials,
                                       const std::vector<std::string>& estimators) {
  SweepSpec spec = experiments::load_sweep(
      experiments::data_dir() + "/experiments/die/sweeps/" + name + ".toml", false);
  spec.trials = trials;
  if (!estimators.empty()) spec.estimators = estimators;
  return spec;
}

void run_slopes(const Options& options, const Report& report) {
  const Limit linear = within(1, 0.03);
  const std::vector<std::string> both{"known_shape", "closed_form"};
  report_slope({"range_noise", 0.2, 6, both, {linear, linear}}, options, report);
  report_slope({"angular_step", 0.5, 4, both, {linear, linear}}, options, report);
  report_slope({"range", 3, 15, both, {within(1.13, 0.08), within(1.40, 0.08)}}, options, report);
}

void run_sweep_ranges(const Options& options, const Report& report) {
  const SweepSpec spec =
      committed_sweep("effective_range", options.trials_or(2), {"closed_form", "known_shape"});
  const SweepRows rows = run_rows(spec);
  const std::array<std::array<double, 2>, 2> expected{{{6.1, 8.5}, {12.5, 21.6}}};  // by die
  for (std::size_t edge = 0; edge < 2; ++edge) {
    for (std::size_t e = 0; e < 2; ++e) {
      double found = 0, before_m = 0, before = 0;
      for (std::uint64_t cell = 0; cell < spec.cells(); ++cell) {
        if (cell % 2 != edge) continue;
        const double range_m = std::get<double>(spec.axis_values(cell)[0]);
        const double bound = rows[cell][0][e].extra[1];
        if (before > 0 && before <= 2.5e-3 && bound > 2.5e-3)
          found = before_m * std::pow(range_m / before_m,
                                      std::log(2.5e-3 / before) / std::log(bound / before));
        before_m = range_m;
        before = bound;
      }
      const double expectation = expected[edge][e];
      report({fmt::format("{} m die, {}: ring of 10 m within 2.5 mm up to",
                          experiments::to_text(spec.axes[1].values[edge]), e == 0 ? "L" : "K"),
              found,
              {found, found},
              within(expectation, 0.05 * expectation),
              1,
              "m",
              Judgement::point});
    }
  }
}

void run_leak_curves(const Options& options, const Report& report) {
  const std::vector<std::string> rules{"fix_x", "fix_y", "fix_z", "polar", "mixed", "closed_form"};
  // Medians of 400 dice each in the die study, section 2, for 0.25, 0.5, 1 and 2 deg.
  const std::array<std::array<double, 4>, 6> medians_deg{{{.541, 1.00, 2.22, 4.33},
                                                          {.240, .455, .944, 2.05},
                                                          {.417, .818, 1.74, 3.32},
                                                          {.218, .425, .871, 1.61},
                                                          {.228, .479, .893, 1.88},
                                                          {0, 0, 0, 0}}};
  const std::uint64_t trials = options.trials_or(1000);
  const SweepSpec spec = committed_sweep("leak", trials, rules);
  const SweepRows rows = run_rows(spec);
  for (std::size_t e = 0; e < rules.size(); ++e) {
    for (std::uint64_t cell = 0; cell < spec.cells(); ++cell) {
      std::vector<double> angles;
      for (const auto& trial : rows[cell])
        if (trial[e].verdict == "registered") angles.push_back(trial[e].rotation_error_rad / deg);
      std::sort(angles.begin(), angles.end());
      const auto at = [&](double share) {
        return angles[static_cast<std::size_t>(share * static_cast<double>(angles.size() - 1) +
                                               0.5)];
      };
      const double half = 0.98 / std::sqrt(static_cast<double>(angles.size()));
      const double study = medians_deg[e][cell];
      // Both medians have their own sampling error of about 5 %.
      report({fmt::format("tilts {} deg, {}: median rotation",
                          experiments::to_text(spec.axis_values(cell)[0]), rules[e]),
              at(0.5),
              {at(0.5 - half), at(0.5 + half)},
              within(study, std::max(5e-4, 0.15 * study)),
              angles.size(),
              "deg",
              Judgement::point});
    }
  }
}

}  // namespace alea::acceptance
