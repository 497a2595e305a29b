#pragma once

#include <cstdint>
#include <string>

#include "alea/core/progress.hpp"

namespace alea::experiments::die {

struct ReproductionOptions {
  std::string out;     ///< folder of the results, made where it is missing
  bool smoke = false;  ///< few dice, for minutes instead of an hour
  std::uint64_t seed = 1;
  ProgressCallback progress;
};

/// The die paper: twins of datasets A to D, Tables 1 to 7, its statements, its errata and the data
/// of its figures, written as text, CSV and LaTeX below `out`. Returns what a reader should see
/// first: the verdicts counted and the files. Throws Error(input).
std::string reproduce_die(const ReproductionOptions& options);

}  // namespace alea::experiments::die
