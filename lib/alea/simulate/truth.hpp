#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "alea/simulate/scene.hpp"

namespace alea {

/// What became of one station of a scene.
struct WrittenScan {
  std::string file;
  std::size_t points = 0;
};

/// The truth about a scene as JSON text (format: README.md of this folder), metres and radians,
/// scene frame; `scans` has one entry for each station, in their order.
std::string truth_json(const Scene& scene, std::uint64_t seed,
                       const std::vector<WrittenScan>& scans);

}  // namespace alea
