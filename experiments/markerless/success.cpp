#include "experiments/markerless/success.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "alea/markerless/pose_covariance.hpp"

namespace alea::experiments::markerless {
namespace {

double rmse_of(const PreparedScan& fixed, const PreparedScan& moving, const RigidTransform& pose) {
  double squares = 0;
  for (const Eigen::Vector3d& p : moving.fine.positions)
    squares += fixed.fine_index.nearest_one(pose * p)->squared_distance_m2;
  return std::sqrt(squares / static_cast<double>(moving.fine.size()));
}

/// Standard deviations of the six parameters as information; the lever arm of a rotation is 5 m.
double least_information(const PreparedScan& fixed, const PreparedScan& moving,
                         const RigidTransform& pose) {
  const auto covariance = pose_covariance(fixed, moving, pose, Eigen::Vector3d::Zero());
  if (!covariance) return 0;
  Vector6d scale;
  scale << Eigen::Vector3d::Constant(5), Eigen::Vector3d::Ones();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scale.asDiagonal() * covariance->covariance *
                                                       scale.asDiagonal());
  return solver.eigenvalues()[0] / solver.eigenvalues()[5];
}

}  // namespace

std::vector<JudgedPose> judged_poses(const PreparedScan& fixed, const PreparedScan& moving,
                                     const std::vector<RigidTransform>& poses,
                                     const RigidTransform& truth) {
  std::vector<JudgedPose> judged;
  for (const RigidTransform& pose : poses) {
    const PoseEvidence evidence = pose_evidence(fixed, moving, pose, {});
    JudgedPose one;
    one.right = pose_error(pose, truth).is_right();
    one.rmse_m = rmse_of(fixed, moving, pose);
    one.overlap = evidence.overlap();
    one.tilt_deg = std::acos(std::clamp(pose.rotation(2, 2), -1.0, 1.0)) * 180 / std::numbers::pi;
    one.conflict_ratio = evidence.conflict_ratio();
    one.least_information = least_information(fixed, moving, pose);
    judged.push_back(one);
  }
  return judged;
}

Interval area_under_roc(const std::vector<double>& right, const std::vector<double>& wrong) {
  if (right.empty() || wrong.empty()) return {0, 0.5, 1};
  double wins = 0;
  for (const double r : right)
    for (const double w : wrong) wins += r < w ? 1 : r == w ? 0.5 : 0;
  const auto n = static_cast<double>(right.size()), m = static_cast<double>(wrong.size());
  const double a = wins / (n * m), q1 = a / (2 - a), q2 = 2 * a * a / (1 + a);
  const double variance = (a * (1 - a) + (n - 1) * (q1 - a * a) + (m - 1) * (q2 - a * a)) / (n * m);
  const double half = 1.96 * std::sqrt(std::max(0.0, variance));
  return {std::max(0.0, a - half), a, std::min(1.0, a + half)};
}

ResultTable success_table(const std::vector<JudgedPose>& poses) {
  ResultTable table{
      "success",
      "How well each figure tells true poses from false ones",
      "Area under the ROC with its 95 % interval (Hanley and McNeil); 0.5 tells nothing.",
      {}};
  struct Figure {
    const char* name;
    double sign;  ///< so that less is better
    double JudgedPose::*value;
  };
  const std::array<Figure, 5> figures{
      {{"RMSE of all points", 1, &JudgedPose::rmse_m},
       {"overlap", -1, &JudgedPose::overlap},
       {"tilt", 1, &JudgedPose::tilt_deg},
       {"least information", -1, &JudgedPose::least_information},
       {"free-space conflict ratio", 1, &JudgedPose::conflict_ratio}}};
  for (const Figure& figure : figures) {
    std::vector<double> right, wrong;
    for (const JudgedPose& pose : poses)
      (pose.right ? right : wrong).push_back(figure.sign * pose.*figure.value);
    table.cells.push_back({figure.name, "area under ROC", "", "", area_under_roc(right, wrong),
                           Verdict::ours,
                           fmt::format("{} true, {} false poses", right.size(), wrong.size())});
  }
  return table;
}

}  // namespace alea::experiments::markerless
