#pragma once

#include <optional>
#include <span>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/evaluate/check_planes.hpp"
#include "alea/pipeline/die_pair.hpp"
#include "alea/pipeline/observe_die.hpp"
#include "alea/pipeline/registration.hpp"

namespace alea {

/// What a registration by the die found on its way, as far as it came.
struct DieStages {
  Cloud master, slave;  ///< in canonical order: all indices point into these
  ScanSighting of_master, of_slave;
  std::optional<DiePair> pair;
  std::vector<CommonPlane> planes;  ///< in the order of Registration::check_planes
};

struct StagedDieRegistration {
  Registration registration;
  DieStages stages;
};

/// register_die with everything that a report shows of it, one for each slave.
std::vector<StagedDieRegistration> register_die_in_stages(const Cloud& master,
                                                          std::span<const Cloud> slaves,
                                                          const DieRegistrationOptions& options);

}  // namespace alea
