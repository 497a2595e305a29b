#pragma once

#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

/// Positions in the cloud along a Morton curve through its bounding box, equal cells by
/// coordinates, then every other field: neighbours in space lie near each other in memory, and what
/// is computed in this order cannot depend on the order of the points in the file. Points must be
/// finite.
std::vector<std::uint32_t> spatial_order(const Cloud& cloud);

}  // namespace alea
