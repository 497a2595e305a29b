#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "experiments/markerless/acceptance.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::acceptance {
namespace {

using namespace experiments::markerless;

/// Committed before the tag markerless-freeze-2, after which the method stayed as it was, and not
/// looked at before it; 1, 2011, 2023 and those of the first freeze, 5207 to 5501, were used to
/// develop the method.
constexpr std::array<std::uint64_t, 10> frozen_layouts{6011, 6029, 6053, 6073, 6091,
                                                       6113, 6133, 6151, 6173, 6199};
/// Of the tower three outdoor and three indoor stations, of the lighthouse six around it.
const std::vector<std::size_t> tower_stations{0, 1, 2, 5, 6, 7},
    lighthouse_stations{0, 1, 2, 3, 5, 7};

struct Outcome {
  std::size_t layout = 0;
  double overlap = 0;  ///< at the truth, mean of both scans
  bool refused = false, ambiguous = false;
  PoseError error;
  double nees = 0;  ///< squared error over its covariance, of 6
};

double true_overlap(const PreparedScan& a, const PreparedScan& b, const RigidTransform& a_from_b) {
  return pose_evidence(a, b, a_from_b, {}).overlap();
}

std::vector<Outcome> run_pairs(const TwinScans& scans, std::size_t layout) {
  std::vector<PreparedScan> prepared;
  for (const Cloud& cloud : scans.clouds) prepared.push_back(prepare_scan(cloud, {}));
  std::vector<Outcome> outcomes;
  for (std::size_t f = 0; f < prepared.size(); ++f)
    for (std::size_t m = f + 1; m < prepared.size(); ++m) {
      const RigidTransform truth = scans.truth(f, m);
      const MarkerlessRegistration found = register_prepared(prepared[f], prepared[m], {});
      Outcome outcome;
      outcome.layout = layout;
      outcome.overlap = true_overlap(prepared[f], prepared[m], truth);
      outcome.refused = found.registration.refusal.has_value();
      if (outcome.refused) {
        outcome.ambiguous = found.registration.refusal->code == RefusalCode::ambiguous_target;
      } else {
        outcome.error = pose_error(*found.registration.master_from_slave, truth);
        const TransformCovariance& c = *found.registration.covariance;
        const Vector6d off =
            left_difference(truth, *found.registration.master_from_slave, c.about_m);
        outcome.nees = off.dot(c.covariance.ldlt().solve(off));
      }
      outcomes.push_back(outcome);
    }
  return outcomes;
}

/// The share over all pairs, its interval from the spread of the layouts' own shares.
void report_share(const std::string& name, const std::vector<Outcome>& outcomes,
                  bool (*holds)(const Outcome&), const Limit& limit, const Report& report) {
  std::vector<double> shares;
  double all = 0;
  for (std::size_t layout = 0; layout < frozen_layouts.size(); ++layout) {
    double count = 0, holding = 0;
    for (const Outcome& outcome : outcomes) {
      if (outcome.layout != layout) continue;
      ++count;
      holding += holds(outcome) ? 1 : 0;
    }
    all += holding;
    if (count > 0) shares.push_back(holding / count);
  }
  const auto k = static_cast<double>(shares.size());
  double mean = 0, squares = 0;
  for (const double share : shares) mean += share / k;
  for (const double share : shares) squares += (share - mean) * (share - mean);
  const double half = k > 1 ? 2.26 * std::sqrt(squares / (k * (k - 1))) : 0;  // t, 9 degrees
  const double value = all / static_cast<double>(std::max<std::size_t>(outcomes.size(), 1));
  report({name,
          value,
          {std::max(0.0, value - half), std::min(1.0, value + half)},
          limit,
          outcomes.size(),
          "",
          Judgement::point});
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

bool is_right(const Outcome& o) {
  return !o.refused && o.error.is_right();
}
bool is_wrong(const Outcome& o) {
  return !o.refused && !o.error.is_right();
}

void report_precision(const std::vector<Outcome>& outcomes, const Report& report) {
  std::vector<double> rotation, shift;
  double covered = 0;
  for (const Outcome& outcome : outcomes) {
    if (!is_right(outcome)) continue;
    rotation.push_back(outcome.error.rotation_deg);
    shift.push_back(outcome.error.translation_m);
    covered += outcome.nees < 12.592 ? 1 : 0;  // chi-square, 6 degrees, 95 %
  }
  const auto n = static_cast<double>(std::max<std::size_t>(rotation.size(), 1));
  const auto cell = [&](const std::string& name, double value, const std::string& unit,
                        const Limit& limit) {
    report({name, value, {value, value}, limit, rotation.size(), unit, Judgement::point});
  };
  cell("when right: rotation error, median", median(rotation), "deg", at_most(0.1));
  cell("when right: translation error, median", median(shift), "m", at_most(0.02));
  const double half = 1.96 * std::sqrt(covered / n * (1 - covered / n) / n);
  report({"when right: truth inside the 95 % ellipsoid",
          covered / n,
          {covered / n - half, covered / n + half},
          {},
          rotation.size(),
          "",
          Judgement::shown});
}

}  // namespace

void run_markerless_layouts(const Options& options, const Report& report) {
  std::vector<Outcome> enough, little;
  const auto layouts = std::min<std::uint64_t>(options.trials_or(10), frozen_layouts.size());
  for (std::size_t i = 0; i < layouts; ++i) {
    TwinOptions twin;
    twin.layout = frozen_layouts[i];
    twin.step_rad = 5e-3;
    const bool tower = i % 2 == 0;
    const TwinScans scans = scan_twin(tower ? bell_tower(twin) : lighthouse(twin),
                                      tower ? tower_stations : lighthouse_stations, twin.layout);
    for (const Outcome& outcome : run_pairs(scans, i))
      (outcome.overlap >= 0.15 ? enough : little).push_back(outcome);
  }
  report_share("overlap of 0.15 and more: right", enough, is_right, at_least(0.85), report);
  report_share(
      "overlap of 0.15 and more: refused", enough, [](const Outcome& o) { return o.refused; }, {},
      report);
  report_share("overlap of 0.15 and more: wrong", enough, is_wrong, at_most(0), report);
  report_share("overlap below 0.15: right", little, is_right, {}, report);
  report_share("overlap below 0.15: wrong", little, is_wrong, at_most(0), report);
  report_precision(enough, report);
}

void run_markerless_bare(const Options& options, const Report& report) {
  const std::uint64_t wanted = options.trials_or(100);
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; outcomes.size() < wanted && i < frozen_layouts.size(); ++i) {
    TwinOptions twin;
    twin.layout = frozen_layouts[i];
    twin.bare = true;
    twin.step_rad = 6e-3;
    const auto pairs = run_pairs(scan_twin(bell_tower(twin), tower_stations, twin.layout), i);
    outcomes.insert(outcomes.end(), pairs.begin(), pairs.end());
  }
  outcomes.resize(std::min<std::size_t>(outcomes.size(), wanted));
  report_share(
      "bare tower: declared ambiguous", outcomes,
      [](const Outcome& o) { return o.refused && o.ambiguous; }, at_least(0.9), report);
  report_share(
      "bare tower: registered", outcomes, [](const Outcome& o) { return !o.refused; }, {}, report);
}

}  // namespace alea::acceptance
