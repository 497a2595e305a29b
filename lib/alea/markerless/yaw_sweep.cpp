#include "alea/markerless/yaw_sweep.hpp"

#include <cmath>
#include <numbers>

#include "alea/core/parallel.hpp"
#include "alea/markerless/height_vote.hpp"
#include "alea/markerless/symmetry_axis.hpp"
#include "alea/markerless/wall_correlation.hpp"

namespace alea {
namespace {

using std::numbers::pi;

/// The poses of upright scans as poses between their local frames, at every height that the
/// horizontal surfaces vote for.
class UprightPoses {
 public:
  UprightPoses(const PreparedScan& fixed, const PreparedScan& moving, double height_range_m)
      : up_fixed_(fixed.upright_from_scan.transpose()),
        up_moving_(moving.upright_from_scan),
        heights_(fixed, moving, height_range_m) {}

  void add(double yaw_rad, const Eigen::Vector2d& shift_m, double score, CandidateSource source,
           std::vector<PoseCandidate>& poses) const {
    for (const double height_m : heights_.best(yaw_rad, shift_m)) {
      RigidTransform pose;
      pose.rotation = up_fixed_ *
                      Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                      up_moving_;
      pose.translation = up_fixed_ * Eigen::Vector3d(shift_m.x(), shift_m.y(), height_m);
      poses.push_back({pose, score, source});
    }
  }

 private:
  Eigen::Matrix3d up_fixed_, up_moving_;
  HeightVote heights_;
};

/// `add(yaw, poses)` for every yaw of a full turn; the poses in the order of the yaws.
template <typename Add>
std::vector<PoseCandidate> for_each_yaw(double step_rad, Add&& add) {
  const auto yaws = static_cast<std::size_t>(std::round(2 * pi / step_rad));
  std::vector<std::vector<PoseCandidate>> found(yaws);
  parallel_chunks(yaws, 1, [&](std::size_t k, std::size_t) {
    add(2 * pi * static_cast<double>(k) / static_cast<double>(yaws), found[k]);
  });
  std::vector<PoseCandidate> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::vector<PoseCandidate> yaw_sweep(const PreparedScan& fixed, const PreparedScan& moving,
                                     const YawSweepOptions& options) {
  const WallCorrelation walls(fixed, moving, {});
  const UprightPoses upright(fixed, moving, options.height_range_m);
  return for_each_yaw(options.yaw_step_rad, [&](double yaw, std::vector<PoseCandidate>& poses) {
    for (const WallShift& wall : walls.best(yaw, options.shifts_per_yaw))
      upright.add(yaw, wall.shift_m, wall.score, CandidateSource::yaw_sweep, poses);
  });
}

std::vector<PoseCandidate> axis_sweep(const PreparedScan& fixed, const PreparedScan& moving,
                                      const YawSweepOptions& options) {
  const auto of_fixed = symmetry_axes(fixed, options.axes);
  const auto of_moving = symmetry_axes(moving, options.axes);
  const UprightPoses upright(fixed, moving, options.height_range_m);
  return for_each_yaw(options.yaw_step_rad, [&](double yaw, std::vector<PoseCandidate>& poses) {
    const Eigen::Rotation2Dd turn(yaw);
    for (const SymmetryAxis& a : of_fixed)
      for (const SymmetryAxis& b : of_moving)
        upright.add(yaw, a.place_m - turn * b.place_m, a.score * b.score,
                    CandidateSource::axis_sweep, poses);
  });
}

}  // namespace alea
