#pragma once

#include "alea/markerless/pose_evidence.hpp"

namespace alea {

/// Evidence with the share of it that says where a scan stands. The ground lies on the ground of
/// another place as well as on its own: what agrees there fixes the height and the tilt, no more.
struct StandingEvidence {
  PoseEvidence evidence;
  double standing = 0;  ///< share of points that agree on surfaces steeper than 45 deg, both scans
  /// Contradiction for each agreement, that of lying surfaces counted a fifth; the constant lets
  /// poses that nothing contradicts follow their agreement. For ranks, not for verdicts.
  double contradiction() const;
};

StandingEvidence standing_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                                   const RigidTransform& fixed_from_moving,
                                   const EvidenceOptions& options);

/// A guess of the same for a pose that may be half a metre off, from every second point of the
/// probes and the maps of surfaces: thousands of poses a second. No residuals.
StandingEvidence rough_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                                const RigidTransform& fixed_from_moving);

}  // namespace alea
