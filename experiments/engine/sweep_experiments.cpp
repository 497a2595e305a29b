#include <fmt/format.h>

#include "alea/core/error.hpp"
#include "experiments/die/sweep_die.hpp"
#include "experiments/die/sweep_pips.hpp"
#include "experiments/engine/sweep_experiment.hpp"
#include "experiments/exactness/kernel_sweep.hpp"

namespace alea::experiments {

std::string to_text(const SweepValue& value) {
  if (const auto* const number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return std::get<std::string>(value);
}

double number_of(const SweepSettings& settings, const std::string& name) {
  return std::get<double>(settings.at(name));
}

const std::string& word_of(const SweepSettings& settings, const std::string& name) {
  return std::get<std::string>(settings.at(name));
}

const std::vector<SweepExperiment>& sweep_experiments() {
  static const std::vector<SweepExperiment> experiments{die::die_sweep(), die::pip_sweep(),
                                                        exactness::kernel_sweep()};
  return experiments;
}

const SweepExperiment& sweep_experiment(const std::string& name) {
  for (const SweepExperiment& experiment : sweep_experiments())
    if (experiment.name == name) return experiment;
  throw input_error(
      fmt::format("no experiment '{}'; this program knows another set of them", name));
}

}  // namespace alea::experiments
