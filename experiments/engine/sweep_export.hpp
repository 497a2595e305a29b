#pragma once

#include <filesystem>
#include <vector>

#include "experiments/engine/trial_store.hpp"

namespace alea::experiments {

/// Writes the verified rows as tidy CSV, one row a trial and estimator in the order of cell, trial
/// and the estimators' names: the columns of `trials` but the checksum. Empty: no number.
/// Returns how many rows. Throws Error(input).
std::uint64_t export_csv(TrialStore& store, const std::filesystem::path& file);

/// Joins shards of one sweep to a store of the whole. Throws Error(input) where they differ in
/// configuration or version, where a trial is missing or there twice, or where a store is damaged;
/// then nothing is written. Returns how many trials were joined.
std::uint64_t merge_stores(const std::vector<std::filesystem::path>& folders,
                           const std::filesystem::path& out);

}  // namespace alea::experiments
