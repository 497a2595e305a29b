#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/die/acceptance.hpp"
#include "experiments/die/twin_tables.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::MethodOutcome;
using experiments::die::TwinMethod;
using experiments::die::TwinOutcome;

// The median with its 95 % interval by order statistics.
Cell median_cell(const std::string& name, std::vector<double> values, const std::string& unit) {
  std::sort(values.begin(), values.end());
  const double last = static_cast<double>(values.size() - 1);
  const double half = 0.98 / std::sqrt(static_cast<double>(values.size()));
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * last + 0.5)];
  };
  Cell cell;
  cell.name = name;
  cell.value = at(0.5);
  cell.interval = {at(0.5 - half), at(0.5 + half)};
  cell.n = values.size();
  cell.unit = unit;
  return cell;
}

// Median over dice of the union RMSE as a multiple of that of the perfect registration.
Cell union_cell(const std::vector<TwinOutcome>& twins, std::size_t plane, TwinMethod method,
                const std::string& name) {
  std::vector<double> ratios;
  for (const TwinOutcome& twin : twins)
    if (twin.of(method).registered)
      ratios.push_back(twin.of(method).union_m[plane] /
                       twin.of(TwinMethod::perfect).union_m[plane]);
  return median_cell(
      fmt::format("{} {}: union RMSE over perfect", twins.front().planes[plane].name, name),
      std::move(ratios), "");
}

// RMS offset over the RMS of the bound; the relative error of an RMS of n normals is 1/sqrt(2 n).
Cell offset_cell(const std::vector<TwinOutcome>& twins, std::size_t plane, TwinMethod method,
                 const std::string& name) {
  double squares = 0, bound = 0;
  std::uint64_t n = 0;
  for (const TwinOutcome& twin : twins) {
    if (!twin.of(method).registered || !(twin.planes[plane].widened_bound_m > 0)) continue;
    squares += std::pow(twin.of(method).offset_m[plane], 2);
    bound += std::pow(twin.planes[plane].widened_bound_m, 2);
    ++n;
  }
  Cell cell;
  cell.name = fmt::format("{} {}: RMS offset over bound L widened by the length's variance",
                          twins.front().planes[plane].name, name);
  cell.value = std::sqrt(squares / bound);
  const double spread = 1.96 / std::sqrt(2.0 * static_cast<double>(n));
  cell.interval = {cell.value * (1 - spread), cell.value * (1 + spread)};
  cell.n = n;
  return cell;
}

void report_plane(const std::vector<TwinOutcome>& twins, std::size_t plane, const Report& report) {
  Cell ratio = union_cell(twins, plane, TwinMethod::closed_form_independent, "closed form");
  ratio.limit = at_most(1.02);
  report(ratio);
  Cell offset = offset_cell(twins, plane, TwinMethod::closed_form_independent, "closed form");
  offset.limit = at_most(1.2);
  report(offset);
  for (const auto& [method, name] :
       {std::pair{TwinMethod::paper_check, "equations 1-8, calibrated on the check planes"},
        std::pair{TwinMethod::paper_independent, "equations 1-8, on other planes"},
        std::pair{TwinMethod::nearest_check, "nearest reading, on the check planes"},
        std::pair{TwinMethod::nearest_independent, "nearest reading, on other planes"},
        std::pair{TwinMethod::spheres_six, "six spheres"}}) {
    Cell beside = union_cell(twins, plane, method, name);
    beside.judgement = Judgement::shown;
    report(beside);
  }
}

}  // namespace

void run_twins(const Options& options, const Report& report) {
  const auto tables = experiments::die::load_published_tables();
  experiments::die::TwinTrialOptions trial;
  trial.seed = options.seed;
  trial.bounds = true;
  trial.prior.noise_scale = {1, 1};
  for (const std::string dataset : {"A", "B", "C", "D"}) {
    const auto twins = experiments::die::run_twins(tables, dataset, trial, options.trials_or(300));
    for (std::size_t plane = 0; plane < twins.front().planes.size(); ++plane)
      report_plane(twins, plane, report);
  }
}

}  // namespace alea::acceptance
