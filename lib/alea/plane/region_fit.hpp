#pragma once

#include <cstdint>
#include <vector>

#include "alea/plane/plane_detector.hpp"

namespace alea {

/// Orthogonal least-squares plane of the points at `indices` (three at least, not on one line),
/// with sums in whole numbers, so that the result has the same bits for any order of the points.
/// Fills plane, centroid and RMSE of the region, and keeps the indices as they are.
PlaneRegion fit_region(const Cloud& cloud, std::vector<std::uint32_t> indices);

/// Regions from the plane number of each point (-1 = none), fitted, those with fewer than
/// `min_points` left out, sorted: largest first, ties by centroid.
std::vector<PlaneRegion> regions_from_labels(const Cloud& cloud,
                                             const std::vector<std::int32_t>& plane_of_point,
                                             std::size_t planes, std::size_t min_points);

}  // namespace alea
