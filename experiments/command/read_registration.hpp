#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/check_planes.hpp"

namespace alea::command {

/// What a JSON of `alea register` holds of one slave.
struct MeasuredRegistration {
  RigidTransform master_from_slave;
  std::optional<TransformCovariance> covariance;
  std::vector<CheckPlane> check_planes;
};

/// Every slave's registration, in the order of the file. Throws Error(input) for another file, a
/// refused registration or a damaged one.
std::vector<MeasuredRegistration> read_registrations(const std::string& path);

}  // namespace alea::command
