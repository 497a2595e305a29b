#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace alea::experiments {

/// What a parameter of an experiment holds.
using SweepValue = std::variant<double, std::string>;

/// "6" or "fix_z".
std::string to_text(const SweepValue& value);

/// A parameter that a sweep may set as base value or vary along an axis.
struct SweepParameter {
  std::string name;
  SweepValue value;  ///< where the sweep says nothing
  double low = 0;    ///< a number lies in [low, high]
  double high = std::numeric_limits<double>::infinity();
  std::vector<std::string> words;  ///< a text is one of these
  std::string what;                ///< meaning and unit, for the table of the docs
};

/// All parameters of one cell by name.
using SweepSettings = std::map<std::string, SweepValue>;

double number_of(const SweepSettings& settings, const std::string& name);
const std::string& word_of(const SweepSettings& settings, const std::string& name);

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// What one estimator made of one trial; not-a-number where there is nothing to say.
struct TrialRow {
  std::string estimator;
  double rotation_error_rad = no_number;
  double translation_error_m = no_number;  ///< at the target
  double check_error_m = no_number;        ///< RMS offset at the check planes
  double bound_rotation_rad = no_number;
  double bound_translation_m = no_number;
  double bound_check_m = no_number;
  std::vector<double> extra;  ///< as the experiment's `extra_columns` name them
  std::string verdict;        ///< "registered", or the code of the refusal
  double duration_s = 0;      ///< CPU time of this row: what the trial shares, and its estimator
};

/// One cell of a sweep, ready to run trials. Trials are pure functions of their number, so any
/// thread may run any of them at any time; a trial runs on the thread that calls it.
class SweepCell {
 public:
  virtual ~SweepCell() = default;
  /// One row for each estimator, in the order that the sweep names them.
  virtual std::vector<TrialRow> run(std::uint64_t trial) const = 0;
};

/// An experiment that sweeps can be made of.
struct SweepExperiment {
  std::string name;
  std::string what;
  std::vector<SweepParameter> parameters;
  std::vector<std::string> estimators;
  std::vector<std::string> extra_columns;
  std::unique_ptr<SweepCell> (*make_cell)(const SweepSettings& settings,
                                          const std::vector<std::string>& estimators,
                                          std::uint64_t seed);
  /// Throws Error(usage) for settings that go not together, before anything runs; may be null.
  void (*check)(const SweepSettings& settings) = nullptr;
};

/// Every experiment, by name.
const std::vector<SweepExperiment>& sweep_experiments();

/// Throws Error(input) naming those that exist.
const SweepExperiment& sweep_experiment(const std::string& name);

}  // namespace alea::experiments
