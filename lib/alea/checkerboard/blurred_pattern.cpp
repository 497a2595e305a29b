#include "alea/checkerboard/blurred_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alea {

BlurredWave::BlurredWave(int cells, double cell_m, double blur_m)
    : edges_(cells - 1),
      cells_per_m_(1 / cell_m),
      half_cells_(0.5 * cells),
      cell_m_(cell_m),
      scale_(1 / (std::numbers::sqrt2 * blur_m)) {
  constexpr double reach = 4.5;  // standard deviations beyond which an edge is a step
  reach_cells_ = reach * blur_m / cell_m;
}

BlurredWave::Value BlurredWave::near_edges(double place_m, double in_cells) const {
  // Edge k (from 1) lies at (k - cells / 2) cells; those within reach are first to last.
  const double low = std::clamp(in_cells - reach_cells_, 0.0, edges_ + 1.0);
  const double high = std::clamp(in_cells + reach_cells_, 0.0, edges_ + 0.5);
  const int below = static_cast<int>(low), last = static_cast<int>(high);
  const int first = std::clamp(below < low ? below + 1 : below, 1, edges_ + 1);
  Value wave;
  wave.value = first % 2 == 1 ? 1 : -1;  // after the edges below `first`
  double sign = -wave.value;
  for (int k = first; k <= last; ++k, sign = -sign) {
    const double from_centre = k - half_cells_;
    const double u = (place_m - from_centre * cell_m_) * scale_;
    const double slope = 2 * std::numbers::inv_sqrtpi * std::exp(-u * u) * scale_;
    wave.value += sign * (1 + std::erf(u));
    wave.by_place += sign * slope;
    wave.by_blur -= sign * slope * u * std::numbers::sqrt2;
    wave.by_cell -= sign * slope * from_centre;
  }
  return wave;
}

}  // namespace alea
