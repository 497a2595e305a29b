#pragma once

#include <vector>

#include "alea/core/rigid_transform.hpp"

namespace alea {

enum class CandidateSource { initial, identity, yaw_sweep, axis_sweep, features, plane_triples };

const char* to_string(CandidateSource source);

/// A pose worth refining, between the scans' local frames (about their scanners).
struct PoseCandidate {
  RigidTransform fixed_from_moving;
  double score = 0;  ///< within its source, larger is better
  CandidateSource source = CandidateSource::identity;
};

/// Same pose within an angle (rad) and a shift (m) of the moving scan's scanner?
bool is_near(const RigidTransform& a, const RigidTransform& b, double angle_rad, double shift_m);

/// The best of each cluster of near poses, best first, at most `count`; equal scores keep their
/// order.
std::vector<PoseCandidate> distinct(std::vector<PoseCandidate> candidates, double angle_rad,
                                    double shift_m, std::size_t count);

}  // namespace alea
