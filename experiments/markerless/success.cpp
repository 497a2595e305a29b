#include "experiments/markerless/success.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "alea/markerless/pose_covariance.hpp"

namespace alea::experiments::markerless {
namespace {

constexpr double arm_m = 5;  // a rotation counts by what it moves there
constexpr std::size_t most_alternatives = 4;

double rmse_of(const PreparedScan& fixed, const PreparedScan& moving, const RigidTransform& pose) {
  double squares = 0;
  for (const Eigen::Vector3d& p : moving.fine.positions)
    squares += fixed.fine_index.nearest_one(pose * p)->squared_distance_m2;
  return std::sqrt(squares / static_cast<double>(moving.fine.size()));
}

/// Smallest over largest eigenvalue of the information, rotations by what they move at `arm_m`.
double least_information_of(const PreparedScan& fixed, const PreparedScan& moving,
                            const RigidTransform& pose) {
  const auto covariance = pose_covariance(fixed, moving, pose, Eigen::Vector3d::Zero());
  if (!covariance) return 0;
  Vector6d scale;
  scale << Eigen::Vector3d::Constant(arm_m), Eigen::Vector3d::Ones();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scale.asDiagonal() * covariance->covariance *
                                                       scale.asDiagonal());
  return solver.eigenvalues()[0] / solver.eigenvalues()[5];
}

struct ConsideredPose {
  std::string source;
  RigidTransform pose;
};

/// Those of the robust search, the least contradicted first.
std::vector<ConsideredPose> robust_poses(const RobustTrial& trial) {
  std::vector<ConsideredPose> poses;
  if (!trial.found.report.best) return poses;
  poses.push_back({"robust", *trial.found.report.best});
  for (const MarkerlessAlternative& other : trial.found.report.alternatives)
    if (poses.size() <= most_alternatives)
      poses.push_back({"alternative", other.fixed_from_moving});
  return poses;
}

/// Least conflict ratio of the poses away from one, less its own.
double margin_of(const std::vector<JudgedPose>& judged, const std::vector<ConsideredPose>& poses,
                 std::size_t of) {
  constexpr double apart_deg = 2, apart_m = 0.3;
  double least = 2;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].source == "paper") continue;
    const PoseError between = pose_error(poses[i].pose, poses[of].pose);
    if (between.rotation_deg > apart_deg || between.translation_m > apart_m)
      least = std::min(least, judged[i].conflict_ratio);
  }
  return std::clamp(least - judged[of].conflict_ratio, -1.0, 1.0);
}

/// Places of the pairs' trials by fixed and moving scan.
template <typename Trial, typename PairOf>
std::map<std::pair<std::size_t, std::size_t>, const Trial*> by_pair(
    const std::vector<Trial>& trials, PairOf&& pair_of) {
  std::map<std::pair<std::size_t, std::size_t>, const Trial*> found;
  for (const Trial& trial : trials) found[pair_of(trial)] = &trial;
  return found;
}

std::size_t place_of(const TwinScans& scans, const std::string& name) {
  return static_cast<std::size_t>(std::find(scans.names.begin(), scans.names.end(), name) -
                                  scans.names.begin());
}

}  // namespace

double closure_m(const RigidTransform& fixed_from_moving, const RigidTransform& moving_from_fixed) {
  const RigidTransform loop = fixed_from_moving * moving_from_fixed;
  return std::hypot(loop.translation.norm(), arm_m * rotation_angle_rad(loop.rotation));
}

std::vector<JudgedPose> judged_poses(const std::string& building, const TwinScans& scans,
                                     const std::vector<PreparedScan>& prepared,
                                     const std::vector<RobustTrial>& robust,
                                     const std::vector<PaperTrial>& paper) {
  const auto robust_of =
      by_pair(robust, [](const RobustTrial& t) { return std::pair(t.pair.fixed, t.pair.moving); });
  const auto paper_of = by_pair(paper, [&](const PaperTrial& t) {
    return std::pair(place_of(scans, t.fixed), place_of(scans, t.moving));
  });
  std::vector<JudgedPose> all;
  for (const auto& [pair, trial] : robust_of) {
    const auto [f, m] = pair;
    const auto reverse = robust_of.find({m, f});
    if (reverse == robust_of.end() || !reverse->second->found.report.best) continue;
    std::vector<ConsideredPose> poses = robust_poses(*trial);
    const auto printed = paper_of.find(pair), printed_reverse = paper_of.find({m, f});
    if (printed != paper_of.end() && printed_reverse != paper_of.end())
      poses.push_back({"paper", printed->second->estimate});
    std::vector<JudgedPose> judged;
    for (const auto& [source, pose] : poses) {
      const PoseEvidence evidence = pose_evidence(prepared[f], prepared[m], pose, {});
      const RigidTransform& back = source == "paper" ? printed_reverse->second->estimate
                                                     : *reverse->second->found.report.best;
      JudgedPose one;
      one.building = building;
      one.fixed = scans.names[f];
      one.moving = scans.names[m];
      one.source = source;
      one.pair = fmt::format("{} {}-{}", building, scans.names[std::min(f, m)],
                             scans.names[std::max(f, m)]);
      one.error = pose_error(pose, scans.truth(f, m));
      one.rmse_m = rmse_of(prepared[f], prepared[m], pose);
      one.overlap = evidence.overlap();
      one.least_information = least_information_of(prepared[f], prepared[m], pose);
      one.tilt_deg = std::acos(std::clamp(pose.rotation(2, 2), -1.0, 1.0)) * 180 / std::numbers::pi;
      one.closure_m = closure_m(pose, back);
      one.conflict_ratio = evidence.conflict_ratio();
      judged.push_back(one);
    }
    for (std::size_t i = 0; i < judged.size(); ++i) judged[i].margin = margin_of(judged, poses, i);
    all.insert(all.end(), judged.begin(), judged.end());
  }
  return all;
}

std::string poses_csv(const std::vector<JudgedPose>& poses) {
  std::string text =
      "building,fixed,moving,source,right,rotation_error_deg,translation_error_m,rmse_m,overlap,"
      "information_ratio,tilt_deg,closure_m,conflict_ratio,margin\n";
  for (const JudgedPose& p : poses)
    text += fmt::format(
        "{},{},{},{},{},{:.3f},{:.4f},{:.4f},{:.4f},{:.3g},{:.3f},{:.4f},{:.4f},{:.4f}\n",
        p.building, p.fixed, p.moving, p.source, p.error.is_right() ? 1 : 0, p.error.rotation_deg,
        p.error.translation_m, p.rmse_m, p.overlap, p.least_information, p.tilt_deg, p.closure_m,
        p.conflict_ratio, p.margin);
  return text;
}

}  // namespace alea::experiments::markerless
