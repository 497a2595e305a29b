#include "alea/pipeline/register_markerless.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/markerless/pose_covariance.hpp"
#include "alea/markerless/standing_agreement.hpp"
#include "alea/pipeline/register_by_paper.hpp"
#include "alea/pipeline/stopwatch.hpp"
#include "alea/transform/reference_point.hpp"

namespace alea {
namespace {

/// Between the scans' own frames, from a pose between their local ones.
RigidTransform own_frames(const PreparedScan& fixed, const PreparedScan& moving,
                          const RigidTransform& local) {
  return {local.rotation, fixed.scanner_m + local.translation - local.rotation * moving.scanner_m};
}

RigidTransform local_frames(const PreparedScan& fixed, const PreparedScan& moving,
                            const RigidTransform& own) {
  return {own.rotation, own.translation - fixed.scanner_m + own.rotation * moving.scanner_m};
}

bool is_determined(const PreparedScan& fixed, const PreparedScan& moving,
                   const RigidTransform& pose, const AcceptanceOptions& options) {
  const auto covariance = pose_covariance(fixed, moving, pose, pose.translation);
  if (!covariance) return false;
  const auto largest_sd = [](const Eigen::Matrix3d& block) {
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues()[2]);
  };
  return largest_sd(covariance->covariance.topLeftCorner<3, 3>()) <
             options.largest_rotation_sd_rad &&
         largest_sd(covariance->covariance.bottomRightCorner<3, 3>()) <
             options.largest_position_sd_m;
}

/// Do surfaces other than the ground agree, and enough for what contradicts the pose? Ground on
/// ground says nothing about the place, however much of it agrees and however it undulates.
bool has_standing(const PreparedScan& fixed, const PreparedScan& moving,
                  const RigidTransform& pose) {
  constexpr double least_standing = 0.001, largest_conflict_for_standing = 0.2;
  const StandingEvidence found = standing_evidence(fixed, moving, pose, {});
  const double conflict = (found.evidence.conflict_fixed + found.evidence.conflict_moving) / 2;
  return found.standing >= least_standing &&
         conflict <= largest_conflict_for_standing * found.standing;
}

/// Root mean square offset of each point of a scan from the tangent plane of its nearest neighbour
/// in the same scan: noise, curvature and what a pair of grids adds. Points of two scans that show
/// the same surfaces are hardly further apart.
double roughness_m(const PreparedScan& scan) {
  constexpr std::size_t chunk = 2048;
  struct Sum {
    double squares = 0;
    std::size_t count = 0;
  };
  std::vector<Sum> parts((scan.fine.size() + chunk - 1) / chunk);
  parallel_chunks(scan.fine.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Sum& part = parts[begin / chunk];
    for (std::size_t i = begin; i < end; ++i)
      for (const Neighbour& near : scan.fine_index.nearest(scan.fine.positions[i], 2)) {
        const Eigen::Vector3d normal = scan.fine.normals[near.index].cast<double>();
        if (near.index == i || normal.dot(scan.fine.normals[i].cast<double>()) <= 0.7) continue;
        const double off = normal.dot(scan.fine.positions[i] - scan.fine.positions[near.index]);
        part.squares += off * off;
        ++part.count;
      }
  });
  Sum sum;
  for (const Sum& part : parts) {
    sum.squares += part.squares;
    sum.count += part.count;
  }
  return sum.count > 0 ? std::sqrt(sum.squares / static_cast<double>(sum.count)) : 0;
}

/// The poses that fit as well as either scan fits itself and that their pairs determine: the others
/// (ground on ground, a wall along a wall) claim nothing that could be true or false. The order
/// stays.
std::vector<PoseHypothesis> determined(const PreparedScan& fixed, const PreparedScan& moving,
                                       const std::vector<PoseHypothesis>& hypotheses,
                                       const AcceptanceOptions& options) {
  // Twice, because a rough scan may meet a smooth one and a pose is not yet perfect.
  const double largest_rmse_m = 2 * std::max(roughness_m(fixed), roughness_m(moving));
  std::vector<std::uint8_t> is(hypotheses.size());
  parallel_chunks(hypotheses.size(), 1, [&](std::size_t i, std::size_t) {
    is[i] = hypotheses[i].evidence.normal_rmse_m <= largest_rmse_m &&
            has_standing(fixed, moving, hypotheses[i].fixed_from_moving) &&
            is_determined(fixed, moving, hypotheses[i].fixed_from_moving, options);
  });
  std::vector<PoseHypothesis> kept;
  for (std::size_t i = 0; i < hypotheses.size(); ++i)
    if (is[i]) kept.push_back(hypotheses[i]);
  return kept;
}

/// Is a pose contradicted so much more than another that it is no rival of it?
bool is_refuted(const PoseEvidence& pose, const PoseEvidence& by,
                const AcceptanceOptions& options) {
  const double ratio = pose.conflict_ratio(), best = by.conflict_ratio();
  return ratio - best >= options.least_margin &&
         (ratio + options.conflict_floor) / (best + options.conflict_floor) >= options.least_factor;
}

/// How many other poses are contradicted about as little as the first and fit about as well.
int rivals(const std::vector<PoseHypothesis>& hypotheses, const AcceptanceOptions& options) {
  const PoseEvidence& best = hypotheses[0].evidence;
  int count = 0;
  for (std::size_t i = 1; i < hypotheses.size(); ++i) {
    const PoseEvidence& evidence = hypotheses[i].evidence;
    // A pose that hardly touches the other scan is not contradicted either: that is no rival.
    if (evidence.overlap() < std::min(options.least_overlap, best.overlap() / 2)) continue;
    if (evidence.normal_rmse_m > options.largest_residual_factor * best.normal_rmse_m) continue;
    // One that free space refuses for itself, by a margin, is none either.
    const double ratio = evidence.conflict_ratio();
    if (ratio > options.largest_conflict_ratio &&
        ratio - best.conflict_ratio() >= options.least_margin)
      continue;
    if (!is_refuted(evidence, best, options)) ++count;
  }
  return count;
}

std::optional<Refusal> reason_to_refuse(const std::vector<PoseHypothesis>& hypotheses,
                                        const AcceptanceOptions& options) {
  if (hypotheses.empty())
    return Refusal{RefusalCode::no_match,
                   "no pose brings the two scans together; do they show the same place?"};
  const PoseEvidence& best = hypotheses[0].evidence;
  if (best.overlap() < options.least_overlap)
    return Refusal{
        RefusalCode::low_overlap,
        fmt::format("{:.1f} % of the points agree at the best pose, {:.1f} % are needed; "
                    "add a station between the two",
                    100 * best.overlap(), 100 * options.least_overlap)};
  if (const int others = rivals(hypotheses, options); others > 0)
    return Refusal{
        RefusalCode::ambiguous_target,
        fmt::format("the scene is symmetric or too plain: {} poses fit about as well; give "
                    "--initial, or scan something that breaks the symmetry",
                    others + 1)};
  const double largest = std::min(options.largest_conflict_ratio,
                                  options.largest_conflict_for_overlap * best.overlap());
  if (best.conflict_ratio() > largest)
    return Refusal{
        RefusalCode::no_match,
        fmt::format("the best pose puts surfaces into space that the other scanner saw through "
                    "(conflict ratio {:.3f}, at most {:.3f}); do the scans show the same place?",
                    best.conflict_ratio(), largest)};
  return std::nullopt;
}

Refusal undetermined() {
  return {RefusalCode::unobservable,
          "the common surfaces leave a direction of motion open (one plane, a pipe, a corridor); "
          "add a station that sees across it"};
}

MarkerlessReport report_of(const PreparedScan& fixed, const PreparedScan& moving,
                           const std::vector<PoseHypothesis>& hypotheses) {
  MarkerlessReport report;
  if (hypotheses.empty()) return report;
  const PoseEvidence& best = hypotheses[0].evidence;
  report.best = own_frames(fixed, moving, hypotheses[0].fixed_from_moving);
  report.overlap_fixed = best.agree_fixed;
  report.overlap_moving = best.agree_moving;
  report.conflict_ratio = best.conflict_ratio();
  report.rmse_m = best.normal_rmse_m;
  for (std::size_t i = 1; i < hypotheses.size(); ++i)
    report.alternatives.push_back({own_frames(fixed, moving, hypotheses[i].fixed_from_moving),
                                   hypotheses[i].evidence.overlap(),
                                   hypotheses[i].evidence.conflict_ratio(),
                                   to_string(hypotheses[i].source)});
  return report;
}

void accept(const PreparedScan& fixed, const PreparedScan& moving, const PoseHypothesis& best,
            Registration& registration) {
  const Eigen::Vector3d about = reference_point(fixed.scanner_m);
  const auto covariance =
      pose_covariance(fixed, moving, best.fixed_from_moving, about - fixed.scanner_m);
  if (!covariance) {
    registration.refusal = undetermined();
    return;
  }
  registration.master_from_slave = own_frames(fixed, moving, best.fixed_from_moving);
  registration.covariance = TransformCovariance{covariance->covariance, about};
}

}  // namespace

MarkerlessRegistration register_prepared(const PreparedScan& fixed, const PreparedScan& moving,
                                         const MarkerlessOptions& options) {
  PoseSearchOptions search;
  search.seed = options.seed;
  if (options.initial) search.initial = local_frames(fixed, moving, *options.initial);
  const std::vector<PoseHypothesis> found = search_pose(fixed, moving, search);
  const std::vector<PoseHypothesis> hypotheses =
      determined(fixed, moving, found, options.acceptance);
  MarkerlessRegistration out;
  out.registration.method = "robust";
  out.report = report_of(fixed, moving, hypotheses.empty() ? found : hypotheses);
  AmbiguityReport ambiguity;
  if (hypotheses.size() > 1) {
    ambiguity.alternatives = rivals(hypotheses, options.acceptance);
    const double floor = options.acceptance.conflict_floor;
    ambiguity.log_likelihood_margin = std::log((hypotheses[1].evidence.conflict_ratio() + floor) /
                                               (hypotheses[0].evidence.conflict_ratio() + floor));
  }
  out.registration.ambiguity = ambiguity;
  const bool open =
      !found.empty() && (hypotheses.empty() ||
                         is_refuted(hypotheses[0].evidence, found[0].evidence, options.acceptance));
  out.registration.refusal =
      open ? undetermined() : reason_to_refuse(hypotheses, options.acceptance);
  if (!out.registration.refusal) accept(fixed, moving, hypotheses[0], out.registration);
  return out;
}

MarkerlessRegistration register_markerless(const Cloud& fixed, const Cloud& moving,
                                           const MarkerlessOptions& options) {
  if (fixed.empty() || moving.empty())
    throw usage_error("register markerless: a scan has no points");
  if (options.method == MarkerlessMethod::paper) return register_by_paper(fixed, moving, options);
  Stopwatch stopwatch;
  PrepareOptions prepare;
  prepare.levelled = options.levelled;
  std::optional<PreparedScan> of_fixed, of_moving;
  parallel_pair([&] { of_fixed = prepare_scan(fixed, prepare); },
                [&] { of_moving = prepare_scan(moving, prepare); });
  const double prepare_s = stopwatch.lap_s();
  MarkerlessRegistration out = register_prepared(*of_fixed, *of_moving, options);
  const double search_s = stopwatch.lap_s();
  out.registration.timing_s = {
      {"prepare", prepare_s}, {"search", search_s}, {"total", prepare_s + search_s}};
  return out;
}

}  // namespace alea
