#include "alea/checkerboard/blurred_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alea {

BlurredWave blurred_wave(double place_m, int cells, double cell_m, double blur_m) {
  constexpr double reach = 4.5;  // standard deviations beyond which an edge is a step
  const int edges = cells - 1;
  // Edge k (from 1) lies at (k - cells / 2) cells.
  const double in_cells = place_m / cell_m + 0.5 * cells;
  const double span = reach * blur_m / cell_m;
  const int first = std::clamp(static_cast<int>(std::ceil(in_cells - span)), 1, edges + 1);
  const int last = std::clamp(static_cast<int>(std::floor(in_cells + span)), 0, edges);
  BlurredWave wave;
  wave.value = first % 2 == 1 ? 1 : -1;  // after the edges below `first`
  double sign = -wave.value;
  for (int k = first; k <= last; ++k, sign = -sign) {
    const double from_centre = k - 0.5 * cells;
    const double u = (place_m - from_centre * cell_m) / (std::numbers::sqrt2 * blur_m);
    const double slope =
        2 * std::numbers::inv_sqrtpi * std::exp(-u * u) / (std::numbers::sqrt2 * blur_m);
    wave.value += sign * (1 + std::erf(u));
    wave.by_place += sign * slope;
    wave.by_blur -= sign * slope * u * std::numbers::sqrt2;
    wave.by_cell -= sign * slope * from_centre;
  }
  return wave;
}

BlurredPattern blurred_pattern(const BoardSpec& board, const Eigen::Vector2d& place_m,
                               const Eigen::Vector2d& blur_m) {
  const BlurredWave x = blurred_wave(place_m.x(), board.columns, board.cell_m, blur_m.x());
  const BlurredWave y = blurred_wave(place_m.y(), board.rows, board.cell_m, blur_m.y());
  BlurredPattern pattern;
  pattern.value = -x.value * y.value;
  pattern.flat = x.by_place == 0 && y.by_place == 0;
  if (pattern.flat) return pattern;
  pattern.by_place = {-x.by_place * y.value, -x.value * y.by_place};
  pattern.by_blur = {-x.by_blur * y.value, -x.value * y.by_blur};
  pattern.by_cell = -x.by_cell * y.value - x.value * y.by_cell;
  return pattern;
}

}  // namespace alea
