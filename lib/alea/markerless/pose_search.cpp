#include "alea/markerless/pose_search.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/markerless/feature_match.hpp"
#include "alea/markerless/plane_triples.hpp"
#include "alea/markerless/standing_agreement.hpp"
#include "alea/markerless/yaw_sweep.hpp"

namespace alea {
namespace {

/// `kernel` none trims the worst pairs: it comes from afar, but a wide gate lets wrong pairs pull.
/// Tukey's weights shut those out where the start is near.
IcpOptions gated(double gate_m, int iterations, RobustKernel kernel) {
  IcpOptions options;
  options.objective = IcpObjective::point_to_plane;
  options.max_distance_m = gate_m;
  options.max_iterations = iterations;
  options.rotation_tolerance_rad = 1e-5;
  options.translation_tolerance_m = 1e-4;
  options.trim_share = kernel == RobustKernel::none ? 0.1 : 0;
  options.kernel = kernel;
  options.normal_angle_rad = std::acos(0.7);
  options.oriented_normals = true;
  return options;
}

/// The most promising by the maps of surfaces and free space: the generator's own score says little
/// where most of what the scans show is not common.
std::vector<PoseCandidate> most_promising(const PreparedScan& fixed, const PreparedScan& moving,
                                          std::vector<PoseCandidate> candidates,
                                          std::size_t count) {
  parallel_chunks(candidates.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const StandingEvidence found = rough_evidence(fixed, moving, candidates[i].fixed_from_moving);
      candidates[i].score = found.evidence.overlap() < 0.05 ? -1e9 : -found.contradiction();
    }
  });
  return distinct(std::move(candidates), 4 * deg, 0.4, count);
}

std::vector<PoseCandidate> all_candidates(const PreparedScan& fixed, const PreparedScan& moving,
                                          const PoseSearchOptions& options) {
  std::vector<PoseCandidate> sweep, axes, features, triples;
  parallel_pair(
      [&] {
        sweep = most_promising(fixed, moving, yaw_sweep(fixed, moving, {}), options.of_yaw_sweep);
        axes = most_promising(fixed, moving, axis_sweep(fixed, moving, {}), options.of_axis_sweep);
      },
      [&] {
        features = feature_candidates(fixed, moving, {.seed = options.seed});
        triples = plane_triple_candidates(fixed, moving, {});
      });
  features.resize(std::min(features.size(), options.of_others));
  triples.resize(std::min(triples.size(), options.of_others));
  std::vector<PoseCandidate> all;
  if (options.initial) all.push_back({*options.initial, 1, CandidateSource::initial});
  all.push_back({{}, 0, CandidateSource::identity});
  for (const auto& part : {sweep, axes, features, triples})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Each refined by its probe against the coarse grid; the least contradicted first.
std::vector<PoseCandidate> refine_coarsely(const PreparedScan& fixed, const PreparedScan& moving,
                                           std::vector<PoseCandidate> candidates,
                                           std::size_t count) {
  const double cell_m = std::max(fixed.cell_m, moving.cell_m);
  const IcpTarget target(fixed.coarse, gated(10 * cell_m, 10, RobustKernel::none));
  EvidenceOptions evidence;
  evidence.agree_m = 2 * cell_m;
  evidence.use_probe = true;
  parallel_chunks(candidates.size(), 1, [&](std::size_t i, std::size_t) {
    PoseCandidate& candidate = candidates[i];
    const RigidTransform start = candidate.fixed_from_moving;
    candidate.score = -1e10;
    for (const RobustKernel kernel : {RobustKernel::none, RobustKernel::tukey}) {
      RigidTransform pose = start;
      for (const IcpOptions& options :
           {gated(10 * cell_m, 10, kernel), gated(4 * cell_m, 10, kernel)})
        pose = icp(target, moving.probe, pose, options).target_from_source;
      const StandingEvidence found = standing_evidence(fixed, moving, pose, evidence);
      const double score = found.evidence.overlap() < 0.03 ? -1e9 : -found.contradiction();
      if (score <= candidate.score) continue;
      candidate.score = score;
      candidate.fixed_from_moving = pose;
    }
  });
  return distinct(std::move(candidates), 2 * deg, 0.3, count);
}

bool less_contradicted(const PoseHypothesis& a, const PoseHypothesis& b) {
  return a.evidence.conflict_ratio() < b.evidence.conflict_ratio();
}

/// Does one describe the common surfaces better than the other, a pose near it? A loose fit may
/// touch a little more of the other scan.
bool fits_better(const PoseEvidence& one, const PoseEvidence& other) {
  return one.normal_rmse_m < other.normal_rmse_m && one.overlap() > 0.9 * other.overlap();
}

/// Of each cluster of near poses the one that fits best, in the place of its first.
std::vector<PoseHypothesis> distinct_poses(const std::vector<PoseHypothesis>& hypotheses) {
  std::vector<PoseHypothesis> kept;
  for (const PoseHypothesis& hypothesis : hypotheses) {
    const auto known = std::find_if(kept.begin(), kept.end(), [&](const PoseHypothesis& other) {
      return is_near(other.fixed_from_moving, hypothesis.fixed_from_moving, 2 * deg, 0.3);
    });
    if (known == kept.end())
      kept.push_back(hypothesis);
    else if (fits_better(hypothesis.evidence, known->evidence))
      *known = hypothesis;
  }
  return kept;
}

/// A hypothesis with its rank, the smaller the better.
struct Ranked {
  PoseHypothesis hypothesis;
  double contradiction = 1e9;
};

/// One ICP against the fine grid, then the evidence of all points.
Ranked refined(const PreparedScan& fixed, const PreparedScan& moving, const IcpTarget& target,
               const Cloud& source, const IcpOptions& options, const RigidTransform& start) {
  const IcpResult result = icp(target, source, start, options);
  const StandingEvidence found = standing_evidence(fixed, moving, result.target_from_source, {});
  Ranked ranked;
  ranked.hypothesis.fixed_from_moving = result.target_from_source;
  ranked.hypothesis.evidence = found.evidence;
  ranked.contradiction = found.contradiction();
  return ranked;
}

/// All candidates on the fine grid, trimmed and under weights; the most promising first.
std::vector<PoseHypothesis> refine_finely(const PreparedScan& fixed, const PreparedScan& moving,
                                          const IcpTarget& target,
                                          const std::vector<PoseCandidate>& candidates,
                                          double cell_m) {
  std::vector<Ranked> ranked(candidates.size());
  parallel_chunks(candidates.size(), 1, [&](std::size_t i, std::size_t) {
    for (const RobustKernel kernel : {RobustKernel::tukey, RobustKernel::none}) {
      const Ranked other =
          refined(fixed, moving, target, moving.coarse, gated(3.5 * cell_m, 15, kernel),
                  candidates[i].fixed_from_moving);
      if (kernel == RobustKernel::tukey || other.contradiction < ranked[i].contradiction)
        ranked[i] = other;
    }
    ranked[i].hypothesis.source = candidates[i].source;
  });
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.contradiction < b.contradiction;
  });
  std::vector<PoseHypothesis> hypotheses;
  hypotheses.reserve(ranked.size());
  for (const Ranked& one : ranked) hypotheses.push_back(one.hypothesis);
  return distinct_poses(hypotheses);
}

/// By all points, to the end: under Tukey's weights at once, and after a trimmed step. The weights
/// take their scale from the ground, which is most of what two scans share, and shut out the walls
/// that would correct a pose 1 deg off; trimmed pairs keep them.
PoseHypothesis refine_fully(const PreparedScan& fixed, const PreparedScan& moving,
                            const IcpTarget& target, double cell_m, const PoseHypothesis& start) {
  const IcpOptions weighted = gated(1.2 * cell_m, 50, RobustKernel::tukey);
  const IcpOptions trimmed = gated(1.2 * cell_m, 15, RobustKernel::none);
  const auto finish = [&](const RigidTransform& from) {
    return refined(fixed, moving, target, moving.fine, weighted, from).hypothesis;
  };
  const RigidTransform near =
      icp(target, moving.fine, start.fixed_from_moving, trimmed).target_from_source;
  PoseHypothesis best = finish(start.fixed_from_moving);
  const PoseHypothesis other = finish(near);
  if (fits_better(other.evidence, best.evidence)) best = other;
  best.source = start.source;
  return best;
}

}  // namespace

std::vector<PoseHypothesis> search_pose(const PreparedScan& fixed, const PreparedScan& moving,
                                        const PoseSearchOptions& options) {
  std::vector<PoseCandidate> candidates = all_candidates(fixed, moving, options);
  candidates = refine_coarsely(fixed, moving, std::move(candidates), options.judged);
  const double cell_m = std::max(fixed.cell_m, moving.cell_m);
  const IcpTarget target(fixed.fine, gated(1.2 * cell_m, 1, RobustKernel::tukey));
  std::vector<PoseHypothesis> hypotheses = refine_finely(fixed, moving, target, candidates, cell_m);
  // All of them: what follows may drop the most promising and take any other.
  parallel_chunks(hypotheses.size(), 1, [&](std::size_t i, std::size_t) {
    hypotheses[i] = refine_fully(fixed, moving, target, cell_m, hypotheses[i]);
  });
  std::stable_sort(hypotheses.begin(), hypotheses.end(), less_contradicted);
  return distinct_poses(hypotheses);
}

}  // namespace alea
