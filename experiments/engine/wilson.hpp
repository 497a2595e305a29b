#pragma once

#include <algorithm>
#include <cmath>

#include "experiments/engine/acceptance.hpp"

namespace alea::acceptance {

/// Wilson's interval of a `share` that was met in `n` trials, `z` standard deviations to each side
/// (Wilson 1927, doi 10.2307/2276774).
inline Interval wilson_interval(double share, double n, double z) {
  const double centre = (share + z * z / (2 * n)) / (1 + z * z / n);
  const double half_width =
      z / (1 + z * z / n) * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {std::max(0.0, centre - half_width), std::min(1.0, centre + half_width)};
}

}  // namespace alea::acceptance
