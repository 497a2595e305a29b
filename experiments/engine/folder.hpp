#pragma once

#include <filesystem>

namespace alea::experiments {

/// Makes the folder of an --out option. Throws Error(input) where it cannot.
void make_folder(const std::filesystem::path& folder);

}  // namespace alea::experiments
