#include "alea/core/noise_model.hpp"

#include <algorithm>
#include <cmath>

namespace alea {

double NoiseModel::normal_sd_m(double range_m, double cos_incidence) const {
  return std::sqrt(normal_variance_m2(range_m, cos_incidence));
}

double NoiseModel::range_sd_m(double range_m, double cos_incidence) const {
  return normal_sd_m(range_m, cos_incidence) / std::max(std::abs(cos_incidence), 1e-6);
}

}  // namespace alea
