#include <algorithm>
#include <cmath>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/evaluate/noise_fit.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {
namespace {

constexpr double first_band_m = 0.006, widest_band_m = 0.2;
constexpr double sigmas_in_band = 5;  // less cuts the tails that are to be measured

/// Scatter of nine tiles in ten is at most this.
double high_scatter_m(const std::vector<NoiseTile>& tiles) {
  std::vector<double> variances;
  for (const NoiseTile& tile : tiles) variances.push_back(tile.variance_m2);
  if (variances.empty()) return 0;
  const auto at = variances.begin() + static_cast<std::ptrdiff_t>(0.9 * (variances.size() - 1.0));
  std::nth_element(variances.begin(), at, variances.end());
  return std::sqrt(*at);
}

}  // namespace

Result<NoiseEstimate> calibrate_noise(const Cloud& cloud, const NoiseFitOptions& options) {
  if (!cloud.scanner_position)
    throw usage_error("noise: ranges and incidence angles need the scanner's position");
  PlaneDetectionOptions detection;
  detection.min_points = 200;
  std::vector<NoiseTile> tiles;
  for (double band_m = first_band_m; band_m <= widest_band_m; band_m *= 1.6) {
    detection.tolerance_m = band_m;
    tiles = noise_tiles(cloud, detect_planes(cloud, detection));
    const double scatter_m = high_scatter_m(tiles);
    if (scatter_m > 0 && sigmas_in_band * scatter_m <= band_m) return fit_noise(tiles, options);
  }
  return Refusal{RefusalCode::no_plane,
                 "no planes that stand clear of the noise; scan a room with walls and floor"};
}

}  // namespace alea
