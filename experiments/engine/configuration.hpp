#pragma once

#include <string>

#include "experiments/engine/sweep_spec.hpp"

namespace alea::experiments {

/// Everything that decides the rows of a sweep, and nothing else, as one line of JSON: stores with
/// the same text hold rows of the same sweep.
std::string configuration_of(const SweepSpec& spec);

/// The sweep that a configuration describes. Throws Error(input).
SweepSpec spec_from(const std::string& configuration);

/// Where two configurations differ first: "trials is 200 there and 300 now"; empty where nowhere.
std::string configuration_difference(const std::string& stored, const std::string& wanted);

}  // namespace alea::experiments
