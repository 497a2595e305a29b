#pragma once

#include <vector>

#include "alea/core/result.hpp"
#include "alea/evaluate/check_planes.hpp"
#include "alea/pipeline/die_pair.hpp"

namespace alea {

/// Which common planes calibrate and which check: `--check-planes` names the check planes;
/// otherwise with `calibrate` or `refine` odd ranks calibrate and even ranks check; otherwise all
/// check. The paper's methods calibrate on all and check on all. Throws Error(input) for a named
/// centroid that no common plane is near.
std::vector<CheckPlaneRole> plane_roles(const std::vector<CommonPlane>& planes,
                                        const DieRegistrationOptions& options);

/// Estimates the transform's lengths on the calibration planes and returns the transform at them.
/// Alea's way: the linear solve, on calibration planes only. The paper's way: golden section on the
/// RMSE of the very planes that check. Refusal unobservable where the planes say nothing about the
/// length.
Result<DieTransform> calibrate_die(const Cloud& master, const Cloud& slave, const DiePair& pair,
                                   const std::vector<CommonPlane>& planes,
                                   const std::vector<CheckPlaneRole>& roles,
                                   const DieRegistrationOptions& options);

}  // namespace alea
