#pragma once

#include "alea/markerless/prepared_scan.hpp"

namespace alea {

struct EvidenceOptions {
  double agree_m = 0;  ///< a point this near to the other scan agrees; 0: the finer cell or 0.1 m
  double agree_cosine = 0.7;   ///< and its normal, both facing their scanners
  double free_margin_m = 0.3;  ///< nearer than the free range by more than this contradicts
  bool use_probe = false;      ///< test the probes of both scans instead of all fine points
};

/// What two scans say about a pose, both ways. Shares are of the points of a scan.
struct PoseEvidence {
  double agree_fixed = 0;  ///< points of the fixed scan that lie on the moving one
  double agree_moving = 0;
  double conflict_fixed = 0;  ///< points of the fixed scan in the free space of the moving one
  double conflict_moving = 0;
  double normal_rmse_m = 0;  ///< along the normal, of the points that agree
  double overlap() const { return (agree_fixed + agree_moving) / 2; }
  /// Contradiction for each agreement: small at the true pose, however small the overlap.
  double conflict_ratio() const {
    const double agree = agree_fixed + agree_moving;
    return agree > 0 ? (conflict_fixed + conflict_moving) / agree : 1e9;
  }
};

/// `fixed_from_moving` between the scans' local frames (about their scanners).
PoseEvidence pose_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                           const RigidTransform& fixed_from_moving, const EvidenceOptions& options);

}  // namespace alea
