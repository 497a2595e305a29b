#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "alea/core/noise_model.hpp"

namespace alea::command {

/// Reads a noise model: range_noise_m, grazing_m, surface_m (metres), angular_noise_rad and
/// range_growth (metres per metre); what is
/// absent keeps its documented default. Throws Error(input) for an unknown, negative or non-finite
/// entry.
NoiseModel read_noise_file(const std::string& path);

nlohmann::json noise_json(const NoiseModel& noise);

}  // namespace alea::command
