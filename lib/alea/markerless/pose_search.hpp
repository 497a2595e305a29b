#pragma once

#include <optional>
#include <vector>

#include "alea/markerless/pose_candidate.hpp"
#include "alea/markerless/pose_evidence.hpp"
#include "alea/markerless/prepared_scan.hpp"
#include "alea/transform/icp.hpp"

namespace alea {

struct PoseSearchOptions {
  std::optional<RigidTransform> initial;  ///< local frames; searched beside the generators
  std::uint64_t seed = 1;
  std::size_t of_yaw_sweep = 28;  ///< candidates that are refined, of each generator
  std::size_t of_axis_sweep = 16;
  std::size_t of_others = 8;
  std::size_t judged = 12;  ///< of all those, refined and judged by all points
};

/// A refined pose with what speaks for and against it.
struct PoseHypothesis {
  RigidTransform fixed_from_moving;  ///< local frames
  PoseEvidence evidence;
  CandidateSource source = CandidateSource::identity;
};

/// Distinct poses of the moving scan, the least contradicted first: candidates from every
/// generator, screened on the coarse grids, refined by point-to-plane ICP, trimmed and under
/// Tukey's weights (the less contradicted result stays), whose pairs must face the same way, and
/// judged by pose_evidence.
std::vector<PoseHypothesis> search_pose(const PreparedScan& fixed, const PreparedScan& moving,
                                        const PoseSearchOptions& options);

}  // namespace alea
