#pragma once

#include <string>
#include <vector>

#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// One pair by the robust method, beside the truth.
struct RobustTrial {
  ScanPair pair;
  MarkerlessRegistration found;
  std::optional<PoseError> error;  ///< none where it refused
};

std::vector<PreparedScan> prepare_scans(const TwinScans& scans);

std::vector<RobustTrial> run_robust(const TwinScans& scans,
                                    const std::vector<PreparedScan>& prepared,
                                    const std::vector<ScanPair>& pairs, std::uint64_t seed,
                                    const ProgressCallback& progress = {});

/// How many pairs are right, refused and wrong, and how far off the right ones are.
void add_robust_cells(const std::string& building, const std::vector<RobustTrial>& trials,
                      ResultTable& table);

}  // namespace alea::experiments::markerless
