#pragma once

#include "alea/pipeline/die_stages.hpp"
#include "alea/report/picture.hpp"

namespace alea {

/// Figure 8's corner frames of the die that was registered: as the master sees it, as the slave
/// sees it, and both in the master's frame. Throws Error(usage) where there is no pair of dice.
Picture frames_picture(const StagedDieRegistration& staged);

}  // namespace alea
