#pragma once

#include <fstream>
#include <string>

#include "experiments/engine/sweep_spec.hpp"
#include "tests/support/program.hpp"

namespace alea::experiments::testing {

/// A sweep of the die that takes milliseconds: 2 x 2 cells, 450 points a scan.
inline std::string small_sweep() {
  return R"(schema = 1
name = "small"
experiment = "die"
estimators = ["closed_form", "paper"]
trials = 7
smoke_trials = 2

[base]
step_mrad = 5

[[axis]]
name = "range_noise_mm"
values = [0.5, 2]

[[axis]]
name = "tilt_kind"
values = ["random", "parallelepiped"]
)";
}

inline std::string write_file(const alea::testing::TemporaryFolder& folder, const std::string& text,
                              const std::string& name = "sweep.toml") {
  std::ofstream(folder.file(name)) << text;
  return folder.file(name);
}

inline SweepSpec spec_of(const std::string& text) {
  const alea::testing::TemporaryFolder folder;
  return load_sweep(write_file(folder, text), false);
}

inline SweepSpec small_spec() {
  return spec_of(small_sweep());
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace alea::experiments::testing
