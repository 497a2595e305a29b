#pragma once

#include <vector>

#include "experiments/engine/database.hpp"
#include "experiments/engine/sweep_spec.hpp"

namespace alea::experiments {

/// What a verified store holds.
struct StoreContents {
  std::vector<bool> done;  ///< by unit = cell * trials + trial
  std::uint64_t done_units = 0;
};

/// Throws Error(input) where the file is shorter than SQLite says it is.
void check_size(Database& database);

/// Reads every row and throws Error(input) at the first that is not as it was written: checksum,
/// sweep, cell, trial and axis values within the configuration, all estimators of a trial there,
/// rows and digest of each cell as counted when they were written.
StoreContents check_rows(Database& database, const SweepSpec& spec);

}  // namespace alea::experiments
