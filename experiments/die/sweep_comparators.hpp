#pragma once

#include "experiments/die/sweep_estimators.hpp"

namespace alea::experiments::die {

/// Six spheres of 145 mm on a ring of 4 m about the die, scanned with the case's step and noise.
Result<RigidTransform> by_spheres(const SweepSight& sight);
SweepBound spheres_bound(const DieCase& setting);

/// Three walls of 0.8 m and a patch of floor of 0.6 m about 2.5 m from the die, none of them a
/// check plane: what calibration planes alone would give.
Result<RigidTransform> by_planes(const SweepSight& sight);
SweepBound planes_bound(const DieCase& setting);

}  // namespace alea::experiments::die
