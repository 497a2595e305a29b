#pragma once

#include <cstdint>
#include <vector>

#include "alea/plane/plane_detector.hpp"

namespace alea {

/// Planes from a detector's labels (-1 = none), which come from three points or from a region's
/// early members: each is fitted to its members; every point then goes to the nearest plane, within
/// the tolerance, of those that have members in the cells around it; and the planes are fitted
/// again. `reach` is the edge of those cells; 0 = four tolerances.
std::vector<PlaneRegion> refitted_regions(const Cloud& cloud,
                                          std::vector<std::int32_t> plane_of_point,
                                          std::size_t planes, const PlaneDetectionOptions& options,
                                          double reach = 0);

}  // namespace alea
