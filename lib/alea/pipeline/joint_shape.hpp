#pragma once

#include <vector>

#include "alea/die/adjustment.hpp"
#include "alea/pipeline/die_joint.hpp"

namespace alea {

/// What the options and the pairs say beforehand of the die that an adjustment sees: a calibrated
/// shape; else a free one with, for each axis of the die, the length of the first edge that some
/// slave shares with the master; else, with the tilt prior, a cube whose facets lean by it.
AdjustmentOptions joint_options(const std::vector<SlaveRun>& runs,
                                const DieRegistrationOptions& options, bool with_tilt_prior);

}  // namespace alea
