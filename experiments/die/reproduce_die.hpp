#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "alea/core/progress.hpp"
#include "experiments/engine/result_table.hpp"

namespace alea::experiments::die {

struct ReproductionOptions {
  std::string out;     ///< folder of the results, made where it is missing
  bool smoke = false;  ///< few dice, for minutes instead of an hour
  std::uint64_t seed = 1;
  ProgressCallback progress;
};

struct Reproduction {
  std::vector<ResultTable> tables;
  std::string no_pictures;  ///< why there are none; empty where they were drawn
};

/// The die paper: twins of datasets A to D, Tables 1 to 7, its statements, its errata and its
/// figures, written as text, CSV, LaTeX, PNG and PDF below `out`. Throws Error(input).
Reproduction reproduce_die(const ReproductionOptions& options);

}  // namespace alea::experiments::die
