#pragma once

#include <vector>

#include "alea/pipeline/slave_run.hpp"

namespace alea {

// What planes of the scene may differ by between scans although they are the same (warp, plaster,
// incidence), when they stand witness against a facet.
inline constexpr double witness_tilt_sd_rad = 3e-4, witness_offset_sd_m = 0.001;

/// Adjusts the master and all slaves that have a die in one least squares and puts the results into
/// the runs: transform, covariance, edges, report, warnings; a slave that stays open keeps its
/// refusal. All pairs must mean the same die of the master. Where the rest of the scene is seen by
/// both scans, its planes take part in the tests of the facets (not in the result, unless
/// join_planes asks for it).
void adjust_together(std::vector<SlaveRun>& runs, const DieRegistrationOptions& options);

}  // namespace alea
