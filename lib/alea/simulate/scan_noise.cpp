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
      range_(stream_key(key, Purpose::range_noise)),
      grazing_(stream_key(key, Purpose::grazing_noise)),
      surface_(stream_key(key, Purpose::surface_noise)),
      angular_(stream_key(key, Purpose::angular_noise)),
      intensity_(stream_key(key, Purpose::intensity_noise)) {}

Eigen::Vector2d ScanNoise::angles_rad(std::uint64_t ray) const {
  const double sd = scanner_.noise.angular_noise_rad;
  if (sd == 0) return Eigen::Vector2d::Zero();
  const auto [azimuth, elevation] = angular_.normal2_at(ray);
  return {sd * azimuth, sd * elevation};
}

double ScanNoise::range_m(std::uint64_t ray, double cos_incidence) const {
  const NoiseModel& noise = scanner_.noise;
  const double cosine = std::clamp(std::abs(cos_incidence), least_cosine, 1.0);
  double error = 0;
  if (noise.range_noise_m > 0) error += noise.range_noise_m * range_.normal_at(ray);
  if (noise.grazing_m > 0)
    error += noise.grazing_m * std::sqrt(1 - cosine * cosine) / cosine * grazing_.normal_at(ray);
  if (noise.surface_m > 0) error += noise.surface_m / cosine * surface_.normal_at(ray);
  return error;
}

double ScanNoise::intensity(std::uint64_t ray) const {
  return scanner_.intensity_noise > 0 ? scanner_.intensity_noise * intensity_.normal_at(ray) : 0;
}

}  // namespace alea
