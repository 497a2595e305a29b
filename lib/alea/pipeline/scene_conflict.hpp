#pragma once

#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"

namespace alea {

/// For each transform, how much of what either scan saw lies where the other one saw through, over
/// how much of it lies on surfaces of the other (PoseEvidence::conflict_ratio): near zero for the
/// true transform, however little the scans share. Throws Error(usage) where a scanner's position
/// is unknown.
std::vector<double> scene_conflicts(const Cloud& master, const Cloud& slave,
                                    const std::vector<RigidTransform>& master_from_slave);

}  // namespace alea
