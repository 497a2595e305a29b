#include "alea/core/noise_model.hpp"

#include <algorithm>
#include <cmath>

namespace alea {

double NoiseModel::normal_sd_m(double range_m, double cos_incidence) const {
  const double cosine = std::clamp(std::abs(cos_incidence), 0.0, 1.0);
  const double sine = std::sqrt(1 - cosine * cosine);
  const double along_ray = std::hypot(range_noise_m, range_growth * range_m) * cosine;
  const double grazing = grazing_m * sine;
  const double pointing = angular_noise_rad * range_m * sine;
  return std::sqrt(along_ray * along_ray + grazing * grazing + surface_m * surface_m +
                   pointing * pointing);
}

double NoiseModel::range_sd_m(double range_m, double cos_incidence) const {
  return normal_sd_m(range_m, cos_incidence) / std::max(std::abs(cos_incidence), 1e-6);
}

}  // namespace alea
