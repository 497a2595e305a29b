#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "alea/plane/plane_detector.hpp"

namespace alea {

/// What a detector says of each point of a cloud.
struct PointLabels {
  static constexpr std::int32_t none = -1;

  explicit PointLabels(std::size_t points) : plane(points, none), contested(points, 0) {}
  std::vector<std::int32_t> plane;
  /// Whether another plane lies within the tolerance too: about a shared border, where noise, not
  /// the nearest plane, says whose the point is.
  std::vector<char> contested;
};

/// Orthogonal least-squares plane of the points at `indices` (three at least, not on one line),
/// with sums in whole numbers, so that the result has the same bits for any order of the points.
/// Fills plane, centroid and RMSE of the region, and keeps the indices as they are. Points marked
/// in `contested` (one mark for each point of the cloud) stay out of the sums, unless they are half
/// of the members or hold half of the breadth.
PlaneRegion fit_region(const Cloud& cloud, std::vector<std::uint32_t> indices,
                       std::span<const char> contested = {});

/// The order of a detector's regions: largest first, ties by centroid.
bool comes_first(const PlaneRegion& a, const PlaneRegion& b);

/// Regions from the labels, fitted, those with fewer than `min_points` left out, sorted.
std::vector<PlaneRegion> regions_from_labels(const Cloud& cloud, const PointLabels& labels,
                                             std::size_t planes, std::size_t min_points);

}  // namespace alea
