#pragma once

#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/progress.hpp"
#include "alea/simulate/ray.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// Names the random numbers of one scan. The same key gives the same bits for any thread count.
struct SimulationKey {
  std::uint64_t seed = 1;
  std::uint32_t experiment = 0;
  std::uint64_t trial = 0;
  std::uint32_t scan = 0;
};

/// What really happened to one point.
struct PointTruth {
  SurfaceId surface;
  double range_m = 0;        ///< from the scanner to the surface along the beam's centre
  double cos_incidence = 1;  ///< of the beam's centre
};

struct SimulatedScan {
  Cloud cloud;
  std::vector<PointTruth> truth;  ///< as long as the cloud
};

/// Scans the scene from a station: one ray for each cell of its grid, row by row, a point where the
/// beam's centre meets a surface within the scanner's range. Points are in the station's own frame
/// with the scanner at its origin.
///
/// The grid is what the scanner reports; the beam leaves along a direction that departs from it by
/// the angular noise. With a beam of some width, range and intensity are means over sub-rays.
/// Range then gets range noise N(0, range_noise_m and range_growth r, summed in squares), grazing
/// noise N(0, grazing_m) times the tangent and surface roughness N(0, surface_m) over the cosine of
/// the incidence angle (capped at 87 deg), intensity gets intensity_noise. Every cause has random
/// numbers of its own, read at the ray's number in the grid: switching one off leaves the others'
/// as they were.
///
/// Throws Error(usage) for an empty grid, or one of more than 1e9 rays.
Cloud simulate_scan(const Scene& scene, const Station& station, const SimulationKey& key,
                    const ProgressCallback& progress = {});

/// The same with the truth of every point.
SimulatedScan simulate_scan_with_truth(const Scene& scene, const Station& station,
                                       const SimulationKey& key,
                                       const ProgressCallback& progress = {});

}  // namespace alea
