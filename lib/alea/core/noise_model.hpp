#pragma once

#include <algorithm>

namespace alea {

/// The scanner's random errors, one number for each cause; zero switches a cause off.
/// The defaults are those of the die study (a survey scanner at a few metres).
struct NoiseModel {
  double range_noise_m = 0.0013;  ///< standard deviation along the ray
  double grazing_m = 0.0008;      ///< along the normal, times the sine of the incidence angle
  double surface_m = 0.0008;      ///< surface roughness along the normal
  double angular_noise_rad = 2.4241e-5;  ///< 5 arc seconds, azimuth and elevation each
  /// Growth of the error along the ray with the range, metres per metre; joins range_noise_m as a
  /// root of summed squares.
  double range_growth = 0;

  /// Variance along the surface normal (m^2) at a range (m) and the cosine of the incidence angle.
  double normal_variance_m2(double range_m, double cos_incidence) const {
    const double cos2 = std::min(cos_incidence * cos_incidence, 1.0);
    const double pointing_m = angular_noise_rad * range_m;
    const double growth_m = range_growth * range_m;
    return (range_noise_m * range_noise_m + growth_m * growth_m) * cos2 + surface_m * surface_m +
           (grazing_m * grazing_m + pointing_m * pointing_m) * (1 - cos2);
  }
  /// Standard deviation along the surface normal (m) at a range (m) and the cosine of the incidence
  /// angle.
  double normal_sd_m(double range_m, double cos_incidence) const;
  /// The same along the ray (m): normal_sd_m over the cosine.
  double range_sd_m(double range_m, double cos_incidence) const;
};

}  // namespace alea
