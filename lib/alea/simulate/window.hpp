#pragma once

#include <Eigen/Core>

namespace alea {

/// The part of the sky that a ball covers: elevations low to high, azimuths within half_width of
/// azimuth (radians; half_width pi means all around).
struct AngularWindow {
  double azimuth_rad = 0;
  double half_width_rad = 0;
  double low_rad = 0;
  double high_rad = 0;
};

/// The window of a ball about `centre_m` (scan frame), widened by `margin_rad`.
AngularWindow angular_window(const Eigen::Vector3d& centre_m, double radius_m,
                             double margin_rad = 0);

}  // namespace alea
