#pragma once

#include <numbers>

namespace alea {

/// Radians of a degree: `30 * deg` is an angle of 30 degrees.
inline constexpr double deg = std::numbers::pi / 180;

/// Degrees of a radian, for what people read.
inline constexpr double deg_per_rad = 180 / std::numbers::pi;

}  // namespace alea
