#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "alea/core/progress.hpp"
#include "experiments/engine/result_table.hpp"

namespace alea::experiments::markerless {

struct ReproductionOptions {
  std::string out;     ///< folder of the results, made where it is missing
  bool smoke = false;  ///< coarse scans and few pairs
  std::uint64_t seed = 1;
  ProgressCallback progress;
};

/// The orientation study: its tables audited, Tables 1 to 4 on the twins, the robust method beside
/// them, station plans and overlays, written below `out`. Throws Error(input).
std::vector<ResultTable> reproduce_markerless(const ReproductionOptions& options);

}  // namespace alea::experiments::markerless
