#include "experiments/command/noise_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "experiments/command/die_file.hpp"

namespace alea::command {
namespace {

struct Entry {
  const char* name;
  double NoiseModel::*value;
};

constexpr std::array<Entry, 5> entries{{{"range_noise_m", &NoiseModel::range_noise_m},
                                        {"grazing_m", &NoiseModel::grazing_m},
                                        {"surface_m", &NoiseModel::surface_m},
                                        {"angular_noise_rad", &NoiseModel::angular_noise_rad},
                                        {"range_growth", &NoiseModel::range_growth}}};

}  // namespace

NoiseModel read_noise_file(const std::string& path) {
  const nlohmann::json document = read_json_file(path, "a noise model (JSON object)");
  if (!document.is_object())
    throw input_error(fmt::format("{}: a noise model is a JSON object", path));
  NoiseModel noise;
  bool any = false;
  for (const Entry& entry : entries) {
    if (!document.contains(entry.name)) continue;
    const nlohmann::json& value = document[entry.name];
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0)
      throw input_error(
          fmt::format("{}: {} must be a number that is not negative", path, entry.name));
    noise.*entry.value = value.get<double>();
    any = true;
  }
  if (!any)
    throw input_error(fmt::format(
        "{}: none of range_noise_m, grazing_m, surface_m, angular_noise_rad, range_growth; see "
        "the README",
        path));
  if (noise.range_noise_m + noise.surface_m + noise.grazing_m + noise.range_growth <= 0)
    throw input_error(
        fmt::format("{}: a scanner without any noise has no covariance; give range_noise_m", path));
  return noise;
}

nlohmann::json noise_json(const NoiseModel& noise) {
  nlohmann::json out = nlohmann::json::object();
  for (const Entry& entry : entries) out[entry.name] = noise.*entry.value;
  return out;
}

}  // namespace alea::command
