#include "alea/simulate/scan_noise.hpp"

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

// Beyond 87 deg the tangent is not a model of anything: a beam has a width.
constexpr double least_cosine = 0.052;

StreamKey stream_key(const SimulationKey& key, Purpose purpose) {
  return {key.seed, key.experiment, key.trial, key.scan, purpose};
}

}  // namespace

ScanNoise::ScanNoise(const Scanner& scanner, const SimulationKey& key)
    : scanner_(scanner),
      angular_(stream_key(key, Purpose::angular_noise)),
      range_and_grazing_(stream_key(key, Purpose::range_noise)),
      surface_and_intensity_(stream_key(key, Purpose::surface_noise)) {}

Eigen::Vector2d ScanNoise::angles_rad(std::uint64_t ray) const {
  const double sd = scanner_.noise.angular_noise_rad;
  if (sd == 0) return Eigen::Vector2d::Zero();
  const auto [azimuth, elevation] = angular_.normal2_at(ray);
  return {sd * azimuth, sd * elevation};
}

ScanNoise::Error ScanNoise::at(std::uint64_t ray, double range_m, double cos_incidence) const {
  const NoiseModel& noise = scanner_.noise;
  const double cosine = std::clamp(std::abs(cos_incidence), least_cosine, 1.0);
  Error error;
  const double range_sd_m = std::hypot(noise.range_noise_m, noise.range_growth * range_m);
  if (range_sd_m > 0 || noise.grazing_m > 0) {
    const auto [range, grazing] = range_and_grazing_.normal2_at(ray);
    const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
    error.range_m += range_sd_m * range + noise.grazing_m * tangent * grazing;
  }
  if (noise.surface_m > 0 || scanner_.intensity_noise > 0) {
    const auto [surface, intensity] = surface_and_intensity_.normal2_at(ray);
    error.range_m += noise.surface_m / cosine * surface;
    error.intensity = scanner_.intensity_noise * intensity;
  }
  return error;
}

}  // namespace alea
