#include "alea/simulate/window.hpp"

#include <cmath>
#include <numbers>

namespace alea {

AngularWindow angular_window(const Eigen::Vector3d& centre_m, double radius_m, double margin_rad) {
  constexpr double right_angle = std::numbers::pi / 2;
  const double distance = centre_m.norm();
  if (distance <= radius_m * (1 + 1e-12)) return {0, std::numbers::pi, -right_angle, right_angle};
  const double angular_radius = std::asin(radius_m / distance) + margin_rad;
  const double elevation = std::asin(centre_m.z() / distance);
  AngularWindow window;
  window.azimuth_rad = std::atan2(centre_m.y(), centre_m.x());
  window.low_rad = elevation - angular_radius;
  window.high_rad = elevation + angular_radius;
  // A cap that reaches the zenith or the nadir is seen all around.
  const bool all_around = std::abs(elevation) + angular_radius >= right_angle;
  window.half_width_rad =
      all_around ? std::numbers::pi : std::asin(std::sin(angular_radius) / std::cos(elevation));
  return window;
}

}  // namespace alea
