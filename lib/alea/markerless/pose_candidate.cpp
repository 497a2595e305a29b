#include "alea/markerless/pose_candidate.hpp"

#include <algorithm>

namespace alea {

const char* to_string(CandidateSource source) {
  switch (source) {
    case CandidateSource::initial:
      return "initial";
    case CandidateSource::identity:
      return "identity";
    case CandidateSource::yaw_sweep:
      return "yaw_sweep";
    case CandidateSource::axis_sweep:
      return "axis_sweep";
    case CandidateSource::features:
      return "features";
    case CandidateSource::plane_triples:
      return "plane_triples";
  }
  return "unknown";
}

bool is_near(const RigidTransform& a, const RigidTransform& b, double angle_rad, double shift_m) {
  return (a.translation - b.translation).norm() < shift_m &&
         rotation_angle_rad(a.rotation.transpose() * b.rotation) < angle_rad;
}

std::vector<PoseCandidate> distinct(std::vector<PoseCandidate> candidates, double angle_rad,
                                    double shift_m, std::size_t count) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const PoseCandidate& a, const PoseCandidate& b) { return a.score > b.score; });
  std::vector<PoseCandidate> kept;
  for (const PoseCandidate& candidate : candidates) {
    if (kept.size() == count) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const PoseCandidate& other) {
      return is_near(other.fixed_from_moving, candidate.fixed_from_moving, angle_rad, shift_m);
    });
    if (!known) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace alea
