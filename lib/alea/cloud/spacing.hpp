#pragma once

#include <optional>

#include "alea/core/cloud.hpp"

namespace alea {

/// Median distance (m) from a point to the nearest one at another place, over a sample of about
/// 1000 points chosen by a hash of their coordinates: the same for any order of the points and any
/// thread count. Empty with fewer than two different points.
std::optional<double> median_spacing_m(const Cloud& cloud);

}  // namespace alea
