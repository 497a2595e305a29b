#pragma once

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

  /// Standard deviation along the surface normal (m) at a range (m) and the cosine of the incidence
  /// angle.
  double normal_sd_m(double range_m, double cos_incidence) const;
  /// The same along the ray (m): normal_sd_m over the cosine.
  double range_sd_m(double range_m, double cos_incidence) const;
};

}  // namespace alea
