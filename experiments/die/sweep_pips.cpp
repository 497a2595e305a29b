#include "experiments/die/sweep_pips.hpp"

#include "alea/core/result.hpp"
#include "alea/die/pips_chain.hpp"
#include "alea/die/pips_likelihood.hpp"
#include "experiments/die/pip_trial.hpp"
#include "experiments/engine/cpu_clock.hpp"

namespace alea::experiments::die {
namespace {

constexpr std::uint32_t pips_number = 41;

Result<PipTriple> by_likelihood(const alea::die::PipTrial& trial,
                                const alea::die::PipTrialOptions& options) {
  PipReaderOptions reader;
  reader.chirality = options.chirality;
  reader.footprint_m = options.footprint_m;
  const Result<PipReading> reading = read_pips(trial.images, 1, reader);
  if (!reading) return reading.refusal();
  return reading->pips;
}

/// The paper's chain: each facet counted, two that agree with a die suffice; or all three must.
Result<PipTriple> by_counting(const alea::die::PipTrial& trial,
                              const alea::die::PipTrialOptions& options, bool all_three) {
  PipTriple counts{};
  for (std::size_t k = 0; k < 3; ++k) counts[k] = count_pips(trial.images[k]).count;
  return all_three ? resolve_all_three(counts, options.chirality)
                   : resolve_any_two(counts, options.chirality);
}

Result<PipTriple> read_by(const std::string& estimator, const alea::die::PipTrial& trial,
                          const alea::die::PipTrialOptions& options) {
  if (estimator == "likelihood") return by_likelihood(trial, options);
  return by_counting(trial, options, estimator == "chain_all_three");
}

class PipCell : public SweepCell {
 public:
  PipCell(const SweepSettings& settings, std::vector<std::string> estimators, std::uint64_t seed)
      : estimators_(std::move(estimators)), seed_(seed) {
    options_.edge_m = number_of(settings, "edge_m");
    options_.range_m = number_of(settings, "range_m");
    options_.step_rad = number_of(settings, "step_mrad") * 1e-3;
    options_.noise_over_contrast = number_of(settings, "noise_over_contrast");
    options_.footprint_m = number_of(settings, "footprint_mm") * 1e-3;
  }

  std::vector<TrialRow> run(std::uint64_t trial) const override {
    const double start = cpu_s();
    const auto images =
        alea::die::make_pip_trial(options_, {seed_, pips_number, trial, 0, Purpose::experiment});
    const double shared_s = cpu_s() - start;
    std::vector<TrialRow> rows;
    for (const std::string& estimator : estimators_) {
      const double begin = cpu_s();
      const Result<PipTriple> read = read_by(estimator, images, options_);
      TrialRow row{estimator};
      const bool right = read && *read == images.pips;
      row.extra = {right ? 1.0 : 0.0, read && !right ? 1.0 : 0.0};
      row.verdict = !read ? to_string(read.refusal().code) : right ? "right" : "wrong";
      row.duration_s = cpu_s() - begin + shared_s;
      rows.push_back(row);
    }
    return rows;
  }

 private:
  std::vector<std::string> estimators_;
  std::uint64_t seed_;
  alea::die::PipTrialOptions options_;
};

std::unique_ptr<SweepCell> make_pips_cell(const SweepSettings& settings,
                                          const std::vector<std::string>& estimators,
                                          std::uint64_t seed) {
  return std::make_unique<PipCell>(settings, estimators, seed);
}

}  // namespace

SweepExperiment pip_sweep() {
  SweepExperiment experiment;
  experiment.name = "pips";
  experiment.what = "one scan of a die in a random orientation, its pips read";
  experiment.parameters = {
      {"edge_m", 0.5, 0.02, 10, {}, "edge of the die (m)"},
      {"range_m", 6.0, 0.5, 200, {}, "scanner to the die, horizontal (m)"},
      {"step_mrad", 0.3, 0.02, 20, {}, "angular step (mrad)"},
      {"noise_over_contrast", 0.17, 0, 10, {}, "intensity noise over the pips' contrast"},
      {"footprint_mm", 8.0, 0, 200, {}, "diameter of the laser spot (mm)"},
  };
  experiment.estimators = {"chain", "chain_all_three", "likelihood"};
  experiment.extra_columns = {"right", "wrong"};
  experiment.make_cell = make_pips_cell;
  return experiment;
}

}  // namespace alea::experiments::die
