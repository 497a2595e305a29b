#include "experiments/checkerboard/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alea/core/angle.hpp"
#include "experiments/checkerboard/success.hpp"
#include "experiments/checkerboard/synthetic_trial.hpp"

namespace alea::acceptance {
namespace {

using namespace experiments::checkerboard;  // NOLINT: the topics are about nothing else

Cell share_cell(const std::string& name, const Share& share, const Limit& limit,
                Judgement judgement) {
  Cell cell;
  cell.name = name;
  cell.value = 100 * share.value();
  cell.interval = {100 * share.low(), 100 * share.high()};
  cell.limit = limit;
  cell.n = share.of;
  cell.unit = std::string("%");
  cell.judgement = judgement;
  return cell;
}

Share successes(const std::vector<SyntheticOutcome>& outcomes, bool symmetric) {
  Share share;
  for (const SyntheticOutcome& one : outcomes) {
    share.good += symmetric ? one.symmetric : one.strict;
    ++share.of;
  }
  return share;
}

}  // namespace

std::vector<Topic> checkerboard_topics() {
  return {
      {"checkerboard", "basin", "coloured ICP, 2 x 2, n = 20, d = 1, bare, identical data",
       run_basin},
      {"checkerboard", "global", "coloured ICP in a wall, and the global method", run_global},
      {"checkerboard", "sensors", "survey-like and low-cost-like sensors against the bound",
       run_sensors},
      {"checkerboard", "refusals", "false centres and false refusals", run_refusals},
      {"checkerboard", "speed", "one crop of 5,000 points, all targets of a million points",
       run_board_speed},
  };
}

void run_basin(const Options& options, const Report& report) {
  constexpr std::uint64_t own = 400;
  for (const int rotation : {0, 10, 20, 30}) {
    for (int shift = 0; shift <= 90; shift += 10) {
      SyntheticCase synthetic;
      synthetic.shift = shift / 100.0;
      synthetic.rotation_rad = rotation * deg;
      const auto outcomes =
          run_trials(synthetic, Method::coloured, options.seed, options.trials_or(own));
      const double limit = rotation == 0 && shift == 90 ? 88 : 96;
      report(share_cell(fmt::format("success, shift {} %, rotation {} deg", shift, rotation),
                        successes(outcomes, false), at_least(limit), Judgement::point));
    }
  }
}

void run_global(const Options& options, const Report& report) {
  constexpr std::uint64_t own = 200;
  for (const Target target : {Target::white_wall, Target::grey_wall}) {
    SyntheticCase synthetic;
    synthetic.shift = 0.6;
    synthetic.noise = 0.01;
    synthetic.target = target;
    report(share_cell(
        fmt::format("coloured ICP, {}, shift 60 %", to_string(target)),
        successes(run_trials(synthetic, Method::coloured, options.seed, options.trials_or(own)),
                  true),
        at_most(20), Judgement::point));
  }
  // The global method: every combination of shift, rotation and noise, a few trials each.
  const std::uint64_t each = std::max<std::uint64_t>(1, options.trials_or(own) / 8);
  for (const Target target :
       {Target::identical, Target::independent, Target::white_wall, Target::grey_wall}) {
    std::vector<SyntheticOutcome> all;
    std::uint64_t number = 0;
    for (const double noise : {0.0, 0.01, 0.05})
      for (const int rotation : {0, 30, 60})
        for (const int shift : {0, 30, 60, 90, 120, 150}) {
          SyntheticCase synthetic;
          synthetic.shift = shift / 100.0;
          synthetic.rotation_rad = rotation * deg;
          synthetic.noise = noise;
          synthetic.target = target;
          const auto some =
              run_trials(synthetic, Method::likelihood, options.seed + 1000 * ++number, each);
          all.insert(all.end(), some.begin(), some.end());
        }
    for (const bool symmetric : {false, true})
      report(share_cell(fmt::format("global method, {}, {}", to_string(target),
                                    symmetric ? "symmetric" : "strict"),
                        successes(all, symmetric), at_least(99), Judgement::interval));
  }
}

}  // namespace alea::acceptance
