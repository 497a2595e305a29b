#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "alea/core/progress.hpp"
#include "experiments/engine/result_table.hpp"

namespace alea::experiments::checkerboard {

struct ReproductionOptions {
  std::string out;     ///< folder of the results, made where it is missing
  bool smoke = false;  ///< few pairs a cell
  std::uint64_t seed = 1;
  ProgressCallback progress;
};

/// The synthetic experiment of the checkerboard paper: Figures 6, 7 and 8 with intervals and Figure
/// 8's standard deviations, its statements as cells with a verdict; tables as text, CSV and LaTeX,
/// figures as PNG and CSV below `out`. Throws Error(input).
std::vector<ResultTable> reproduce_checkerboard(const ReproductionOptions& options);

}  // namespace alea::experiments::checkerboard
