#pragma once

#include <cstddef>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

/// A small flat piece of a scan and how its points scatter.
struct NoiseTile {
  std::size_t points = 0;
  double variance_m2 = 0;  ///< along the normal, about the tile's own plane (three freedoms gone)
  /// Means over the points, r the range and i the incidence angle: of what each cause of
  /// NoiseModel contributes for a unit variance.
  double cos2 = 1, range2_cos2_m2 = 0, sin2 = 0, range2_sin2_m2 = 0;
};

struct NoiseTileOptions {
  double largest_m = 1.6;       ///< side of the squares that a plane is first cut into
  double smallest_m = 0.1;      ///< squares are halved down to this while points last
  std::size_t min_points = 50;  ///< a tile with four times as many is cut again
  double least_cosine = 0.1;    ///< of the incidence angle: beyond, a beam's width decides
  double outlier_sigmas = 3.5;  ///< by the median absolute deviation; the rest is corrected for
                                ///< the tails cut off
};

/// Cuts plane regions into squares, denser parts into smaller ones, and fits a plane to each. Tiles
/// that are a line of points, or have fewer than half of min_points, are left out. Throws
/// Error(usage) for a cloud without a scanner position.
std::vector<NoiseTile> noise_tiles(const Cloud& cloud, const std::vector<PlaneRegion>& regions,
                                   const NoiseTileOptions& options = {});

}  // namespace alea
