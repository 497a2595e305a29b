#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/engine/sweep_experiment.hpp"

namespace alea::experiments {

struct SweepAxis {
  std::string name;  ///< of a parameter
  std::vector<SweepValue> values;
};

/// A sweep: every combination of the axes' values is a cell, every cell gets the same trials.
struct SweepSpec {
  std::string name;
  std::string title;
  std::string experiment;
  SweepSettings base;  ///< every parameter of the experiment
  std::vector<SweepAxis> axes;
  std::vector<std::string> estimators;
  std::uint64_t trials = 0;  ///< of each cell
  std::uint64_t seed = 1;
  bool smoke = false;

  std::uint64_t cells() const;
  std::uint64_t units() const { return cells() * trials; }  ///< pairs of cell and trial
  /// Values of the axes in a cell; the last axis runs fastest.
  std::vector<SweepValue> axis_values(std::uint64_t cell) const;
  SweepSettings settings(std::uint64_t cell) const;
};

/// Version of the TOML schema and of the store's tables.
inline constexpr int sweep_schema = 1;

/// Reads a sweep file (schema: README.md of this folder). `smoke`: the small size. Throws
/// Error(input) with file, line, key, value and expectation.
SweepSpec load_sweep(const std::filesystem::path& file, bool smoke);

}  // namespace alea::experiments
