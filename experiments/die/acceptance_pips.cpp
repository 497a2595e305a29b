#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "alea/core/parallel.hpp"
#include "alea/die/pips_chain.hpp"
#include "alea/die/pips_likelihood.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/pip_trial.hpp"
#include "experiments/engine/wilson.hpp"

namespace alea::acceptance {
namespace {

/// One-sided 5 % over up to 26 cells (Bonferroni, which is stricter than Holm).
constexpr double z_over_all_cells = 2.9;

Cell proportion(const std::string& name, std::uint64_t hits, std::uint64_t n, const Limit& limit,
                Judgement judgement = Judgement::interval) {
  const double count = static_cast<double>(n), p = static_cast<double>(hits) / count;
  return {name, p, wilson_interval(p, count, z_over_all_cells), limit, n, "", judgement};
}

/// What one trial gave.
struct Outcome {
  int side_facets_right = 0;  ///< of two, by the chain
  bool top_right = false;     ///< by the chain
  bool two_facets_right = false, two_facets_wrong = false;
  bool likelihood_right = false, likelihood_wrong = false;
};

Outcome run_trial(const die::PipTrialOptions& options, const StreamKey& key) {
  const die::PipTrial trial = die::make_pip_trial(options, key);
  Outcome outcome;
  PipTriple counts{};
  for (std::size_t k = 0; k < 3; ++k) counts[k] = count_pips(trial.images[k]).count;
  for (std::size_t k = 0; k < 2; ++k)
    outcome.side_facets_right += counts[k] == trial.pips[k] ? 1 : 0;
  outcome.top_right = counts[2] == trial.pips[2];
  if (const auto two = resolve_any_two(counts, options.chirality)) {
    outcome.two_facets_right = *two == trial.pips;
    outcome.two_facets_wrong = !outcome.two_facets_right;
  }
  PipReaderOptions reader;
  reader.chirality = options.chirality;
  reader.footprint_m = options.footprint_m;
  if (const auto reading = read_pips(trial.images, 1, reader)) {
    outcome.likelihood_right = reading->pips == trial.pips;
    outcome.likelihood_wrong = !outcome.likelihood_right;
  }
  return outcome;
}

struct Tally {
  std::uint64_t n = 0, side = 0, top = 0, two_right = 0, two_wrong = 0, right = 0, wrong = 0;
};

Tally run_trials(const die::PipTrialOptions& setting, std::uint32_t cell, const Options& options,
                 std::uint64_t trials) {
  std::vector<Outcome> outcomes(trials);
  parallel_chunks(trials, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      outcomes[t] = run_trial(setting, {options.seed, cell, t, 0, Purpose::experiment});
  });
  Tally tally{.n = trials};
  for (const Outcome& outcome : outcomes) {
    tally.side += static_cast<std::uint64_t>(outcome.side_facets_right);
    tally.top += outcome.top_right ? 1 : 0;
    tally.two_right += outcome.two_facets_right ? 1 : 0;
    tally.two_wrong += outcome.two_facets_wrong ? 1 : 0;
    tally.right += outcome.likelihood_right ? 1 : 0;
    tally.wrong += outcome.likelihood_wrong ? 1 : 0;
  }
  return tally;
}

}  // namespace

void run_pips(const Options& options, const Report& all_cells) {
  constexpr std::uint32_t experiment = 70;
  constexpr std::uint64_t own_trials = 3000;
  const std::uint64_t trials = options.trials_or(own_trials);
  const Report report = [&](Cell cell) {
    if (cell.judgement == Judgement::interval) cell.judgement = options.judgement(own_trials);
    all_cells(cell);
  };
  for (const double range_m : {3.0, 6.0, 12.0, 20.0, 30.0, 40.0}) {
    die::PipTrialOptions setting;
    setting.range_m = range_m;
    const Tally tally = run_trials(setting, experiment, options, trials);
    const std::string at = fmt::format("{:.0f} m, .3 mrad, noise .17: ", range_m);
    // The two side facets of a trial share nothing but the pose, so they count as two.
    report(proportion(at + "chain, side facets", tally.side, 2 * tally.n, at_least(0.95),
                      range_m <= 30 ? Judgement::interval : Judgement::shown));
    report(proportion(at + "chain, top facet", tally.top, tally.n, {}, Judgement::shown));
    report(proportion(at + "chain, two facets, wrong and accepted", tally.two_wrong, tally.n, {},
                      Judgement::shown));
    report(proportion(at + "likelihood, right", tally.right, tally.n, at_least(0.99)));
    report(proportion(at + "likelihood, wrong and accepted", tally.wrong, tally.n, at_most(0.01)));
  }
  for (const double edge_m : {0.5, 0.3})
    for (const double range_m : {12.0, 20.0, 30.0}) {
      die::PipTrialOptions setting;
      setting.edge_m = edge_m;
      setting.range_m = range_m;
      setting.step_rad = 1e-3;
      setting.noise_over_contrast = 0.5;
      const Tally tally = run_trials(setting, experiment + 1, options, trials);
      const std::string at =
          fmt::format("{:.1f} m die, {:.0f} m, 1 mrad, noise .5: ", edge_m, range_m);
      report(proportion(at + "likelihood, right", tally.right, tally.n, {}, Judgement::shown));
      report(proportion(at + "wrong and accepted", tally.wrong, tally.n, at_most(0.01)));
      report(proportion(at + "chain, two, wrong", tally.two_wrong, tally.n, {}, Judgement::shown));
    }
}

}  // namespace alea::acceptance
