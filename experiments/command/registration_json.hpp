#pragma once

#include <nlohmann/json.hpp>

#include "alea/pipeline/registration.hpp"
#include "experiments/command/command.hpp"

namespace alea::command {

/// The result of a registration as the command contract has it: metres and degrees as the names
/// say.
nlohmann::json registration_json(const Registration& registration, std::uint64_t seed);

nlohmann::json check_plane_json(const CheckPlane& plane);

/// `master_from_slave` of a JSON of `register`, or 16 numbers row by row separated by blanks,
/// commas or line ends. Throws Error(input): unreadable, not a rigid transform, or a refused
/// registration.
RigidTransform read_transform(const std::string& path);

/// What a person reads on standard output when no JSON goes there.
void print_registration(const Registration& registration);
void print_check_planes(const std::vector<CheckPlane>& planes);

/// Writes or prints the registrations of one master and each slave in turn: the first at the top
/// level, all of them under `registrations` where there are several. Returns the exit code: refused
/// if any of them is.
int finish_registrations(const CommonOptions& options,
                         const std::vector<Registration>& registrations);

}  // namespace alea::command
