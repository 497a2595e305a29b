#pragma once

#include <span>
#include <vector>

#include "alea/core/rigid_transform.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

/// A transform under which planes of two scans may be the same, and the points that speak for it.
struct PlaneHypothesis {
  RigidTransform master_from_slave;
  double score = 0;
};

/// Transforms that carry three large planes of the slave onto three of the master with the same
/// angles between them, best first: the score adds up the points of all planes that then agree
/// within 2 deg and 0.1 m. Hypotheses that differ by less than 2 deg and 0.1 m at the master's
/// planes are one. The normals must point to the scanners (PlaneRegion of a cloud that knows its
/// scanner's position): that tells floor from ceiling. Empty where no three planes fit.
std::vector<PlaneHypothesis> plane_hypotheses(std::span<const PlaneRegion> master,
                                              std::span<const PlaneRegion> slave);

}  // namespace alea
