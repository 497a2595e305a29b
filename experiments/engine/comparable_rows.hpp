#pragma once

#include <filesystem>
#include <string>

namespace alea::experiments {

/// Every row of a store as text, without what may differ between two runs of one sweep: duration
/// and the checksum over it. No row is verified.
std::string comparable_rows(const std::filesystem::path& folder);

/// The same with every column: what a flipped byte in a row's values must change.
std::string all_rows(const std::filesystem::path& folder);

}  // namespace alea::experiments
