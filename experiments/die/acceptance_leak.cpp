#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/paper_registration.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/mixed_axes.hpp"
#include "experiments/die/skewed_die.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::draw_skewed_die;
using experiments::die::pose_error;
using experiments::die::PoseError;
using experiments::die::SkewedDie;
using experiments::die::SkewedDieOptions;

constexpr double nominal_edge_m = 0.5;

RigidTransform by_rule(const SkewedDie& die, FrameRule rule) {
  PaperRegistrationOptions options;
  options.dimensions = {nominal_edge_m, nominal_edge_m, nominal_edge_m};
  options.rule = rule;
  options.up_pips = 1;
  return (*register_paper(die.master, die.slave, options)).master_from_slave;
}

RigidTransform by_shared_edge(const SkewedDie& die, double edge_m) {
  ClosedFormOptions options;
  options.edge_m = edge_m;
  return (*register_closed_form(die.master, die.slave, options)).master_from_slave;
}

RigidTransform by_true_edge(const SkewedDie& die) {
  return by_shared_edge(die, die.shared_edge_m.value());
}
RigidTransform by_nominal_edge(const SkewedDie& die) {
  return by_shared_edge(die, nominal_edge_m);
}

RigidTransform by_mixed_axes(const SkewedDie& die) {
  return experiments::die::turn_by_mixed_axes(die.master, die.slave, by_true_edge(die));
}

template <FrameRule rule>
RigidTransform with_rule(const SkewedDie& die) {
  return by_rule(die, rule);
}

/// A frame of the study's section 2 with the medians printed there for tilts of .25, .5, 1, 2 deg.
struct Row {
  std::string name;
  double separation_deg;
  RigidTransform (*estimate)(const SkewedDie&);
  double accepted_half_width_deg;  ///< at 0.5 deg, zero: shown, not judged
  std::array<double, 4> printed_deg;
};

std::vector<Row> rows() {
  return {
      {"fix Z", 90, with_rule<FrameRule::fix_z>, 0.10, {.417, .82, 1.74, 3.32}},
      {"fix X", 90, with_rule<FrameRule::fix_x>, 0, {.541, 1.00, 2.22, 4.33}},
      {"fix Y", 90, with_rule<FrameRule::fix_y>, 0, {.240, .455, .944, 2.05}},
      {"top normal + edge", 90, with_rule<FrameRule::top_normal>, 0, {.244, .419, 1.02, 1.87}},
      {"polar", 90, with_rule<FrameRule::polar>, 0.06, {.218, .43, .871, 1.61}},
      {"shared edge, mixed second axis", 90, by_mixed_axes, 0.08, {.228, .48, .893, 1.88}},
      {"shared edge, true length", 90, by_true_edge, 5e-4, {0, 0, 0, 0}},
      {"shared edge, nominal length", 90, by_nominal_edge, 5e-4, {0, 0, 0, 0}},
      {"fix Z", 180, with_rule<FrameRule::fix_z>, 0.12, {.530, 1.11, 2.10, 4.34}},
      {"fix Y", 180, with_rule<FrameRule::fix_y>, 0, {.232, .452, .902, 1.74}},
      {"polar", 180, with_rule<FrameRule::polar>, 0, {.305, .626, 1.21, 2.50}},
      {"top normal + mean heading",
       180,
       with_rule<FrameRule::mean_heading>,
       0,
       {.169, .341, .684, 1.17}},
  };
}

std::vector<PoseError> run_dice(const SkewedDieOptions& geometry, const Options& options,
                                std::size_t count, RigidTransform (*estimate)(const SkewedDie&)) {
  std::vector<PoseError> errors(count);
  parallel_chunks(count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t trial = begin; trial < end; ++trial) {
      const SkewedDie die = draw_skewed_die(geometry, options.seed, trial);
      errors[trial] = pose_error(estimate(die), die);
    }
  });
  return errors;
}

/// Sorted values of one member.
std::vector<double> sorted(const std::vector<PoseError>& errors, double PoseError::*member,
                           double unit) {
  std::vector<double> values;
  for (const PoseError& error : errors) values.push_back(error.*member / unit);
  std::sort(values.begin(), values.end());
  return values;
}

double quantile(const std::vector<double>& values, double share) {
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

/// The median with its 95 % interval by order statistics (binomial, normal approximation).
Cell median_cell(const std::string& name, const std::vector<double>& values,
                 const std::string& unit) {
  const double half = 0.98 / std::sqrt(static_cast<double>(values.size()));
  Cell cell;
  cell.name = name;
  cell.value = quantile(values, 0.5);
  cell.interval = {quantile(values, std::max(0.0, 0.5 - half)),
                   quantile(values, std::min(1.0, 0.5 + half))};
  cell.n = values.size();
  cell.unit = unit;
  return cell;
}

void report_row(const Row& row, double tilt_deg, double printed_deg, const Options& options,
                const Report& report) {
  SkewedDieOptions geometry;
  geometry.tilt_sd_rad = tilt_deg * deg;
  geometry.separation_rad = row.separation_deg * deg;
  const auto errors = run_dice(geometry, options, options.trials_or(400), row.estimate);
  const auto angles = sorted(errors, &PoseError::rotation_rad, deg);
  const std::string name =
      fmt::format("{:g} deg stations, tilts {:g} deg: {}", row.separation_deg, tilt_deg, row.name);
  Cell median = median_cell(name, angles, "deg");
  const bool judged = tilt_deg == 0.5 && row.accepted_half_width_deg > 0;
  median.judgement = judged ? Judgement::point : Judgement::shown;
  median.limit = within(printed_deg, judged ? row.accepted_half_width_deg : 0);
  report(median);
  Cell spread = median;
  spread.name = "  95 % of the dice up to";
  spread.value = quantile(angles, 0.975);
  spread.interval = {quantile(angles, 0.025), spread.value};
  spread.limit = {};
  spread.judgement = Judgement::shown;
  report(spread);
  Cell ring = median_cell("  median displacement on a ring of 5 m",
                          sorted(errors, &PoseError::ring5_m, 1e-3), "mm");
  ring.judgement = Judgement::shown;
  report(ring);
}

}  // namespace

void run_leak(const Options& options, const Report& report) {
  const std::array<double, 4> tilts_deg{0.25, 0.5, 1, 2};
  for (const Row& row : rows())
    for (std::size_t k = 0; k < tilts_deg.size(); ++k)
      report_row(row, tilts_deg[k], row.printed_deg[k], options, report);
}

void run_exactness(const Options& options, const Report& report) {
  SkewedDieOptions geometry;
  geometry.tilt_sd_rad = 2 * deg;
  geometry.size_sd_share = 0.05;
  const auto errors = run_dice(geometry, options, options.trials_or(1000), by_true_edge);
  const auto worst = [&](const std::string& name, double PoseError::*member,
                         const std::string& unit) {
    Cell cell;
    cell.name = name;
    cell.value = sorted(errors, member, 1).back();
    cell.interval = {0, cell.value};
    cell.limit = at_most(1e-9);
    cell.n = errors.size();
    cell.unit = unit;
    report(cell);
  };
  worst("shared edge, tilts 2 deg, sizes 5 %: largest rotation", &PoseError::rotation_rad, "rad");
  worst("shared edge, tilts 2 deg, sizes 5 %: largest translation", &PoseError::at_die_m, "m");
}

}  // namespace alea::acceptance
