#include "alea/transform/icp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"

namespace alea {

static void PrintTo(IcpObjective objective, std::ostream* out) {
  switch (objective) {
    case IcpObjective::point_to_point:
      *out << "point_to_point";
      break;
    case IcpObjective::point_to_plane:
      *out << "point_to_plane";
      break;
    case IcpObjective::coloured:
      *out << "coloured";
      break;
  }
}

namespace {

/// Three walls of a corner with a grid of points, normals and a smooth pattern of intensity.
Cloud corner(int side, double noise_m = 0, std::uint64_t seed = 1) {
  RandomStream noise({seed, 40, 0, 0, Purpose::test});
  Cloud cloud;
  for (int wall = 0; wall < 3; ++wall)
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero(), n = Eigen::Vector3d::Unit(wall);
        p[(wall + 1) % 3] = (i + 0.5) / side;
        p[(wall + 2) % 3] = (j + 0.5) / side;
        const double value = 0.5 + 0.4 * std::sin(7 * p.x() + 3 * p.y()) * std::cos(5 * p.z() + 1);
        cloud.positions.push_back(p + noise_m * noise.normal() * n);
        cloud.normals.push_back(n.cast<float>());
        cloud.intensity.push_back(static_cast<float>(value));
      }
  return cloud;
}

/// A flat board in z = 0 with a smooth pattern.
Cloud board(int side) {
  Cloud cloud;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double x = (i + 0.5) / side - 0.5, y = (j + 0.5) / side - 0.5;
      cloud.positions.emplace_back(x, y, 0);
      cloud.normals.emplace_back(0, 0, 1);
      cloud.intensity.push_back(static_cast<float>(0.5 + 0.4 * std::sin(4 * x) * std::cos(4 * y)));
    }
  return cloud;
}

Cloud moved(const RigidTransform& to_from_from, Cloud cloud) {
  for (Eigen::Vector3d& p : cloud.positions) p = to_from_from * p;
  for (Eigen::Vector3f& n : cloud.normals)
    n = (to_from_from.rotation * n.cast<double>()).cast<float>();
  return cloud;
}

RigidTransform motion(double angle_rad, const Eigen::Vector3d& shift_m) {
  return {rotation_exp(angle_rad * Eigen::Vector3d(1, -2, 0.5).normalized()), shift_m};
}

void expect_near(const RigidTransform& a, const RigidTransform& b, double rad, double m) {
  EXPECT_LT(rotation_angle_rad(a.rotation * b.rotation.transpose()), rad);
  EXPECT_LT((a.translation - b.translation).norm(), m);
}

class EveryObjective : public ::testing::TestWithParam<IcpObjective> {
 protected:
  IcpOptions options() const {
    IcpOptions options;
    options.objective = GetParam();
    options.max_iterations = 100;
    options.settled_change = 0;
    options.gradient_radius_m = 0.1;
    return options;
  }
};

TEST_P(EveryObjective, FindsAKnownMotionOfACorner) {
  const RigidTransform truth = motion(3 * deg, {0.01, -0.008, 0.012});
  const IcpResult result = icp(corner(30), moved(truth.inverse(), corner(30)), {}, options());
  expect_near(result.target_from_source, truth, 1e-6, 1e-6);
  EXPECT_EQ(result.stop, IcpStop::step_small);
  EXPECT_EQ(result.determined, 6);
  EXPECT_NEAR(result.fitness, 1, 1e-12);
}

TEST_P(EveryObjective, FollowsTheFrameOfTheTarget) {
  const RigidTransform truth = motion(3 * deg, {0.01, -0.008, 0.012});
  const RigidTransform frame{rotation_exp({0.3, 1.1, -0.7}), {5e5, -2e5, 300}};
  const Cloud source = moved(truth.inverse(), corner(25));
  const IcpResult here = icp(corner(25), source, {}, options());
  const IcpResult there = icp(moved(frame, corner(25)), source, frame, options());
  // Normals are stored as floats, so turning them costs 6e-8 rad each.
  expect_near(there.target_from_source, frame * here.target_from_source, 5e-5, 5e-5);
}

TEST_P(EveryObjective, GivesTheSameBitsForAnyThreadCountAndOrderOfThePoints) {
  const Cloud target = corner(40, 0.002, 1);
  const Cloud source = moved(motion(2 * deg, {0.01, 0, 0.01}), corner(40, 0.002, 2));
  std::vector<std::uint32_t> backwards(source.size());
  for (std::uint32_t i = 0; i < backwards.size(); ++i)
    backwards[i] = static_cast<std::uint32_t>(source.size()) - 1 - i;
  const IcpResult reference = icp(target, source, {}, options());
  const ThreadLimit one(1);
  const IcpResult other = icp(subset(target, backwards), subset(source, backwards), {}, options());
  EXPECT_EQ(reference.target_from_source.matrix(), other.target_from_source.matrix());
  EXPECT_EQ(reference.information, other.information);
  EXPECT_EQ(reference.rmse_m, other.rmse_m);
}

INSTANTIATE_TEST_SUITE_P(Icp, EveryObjective,
                         ::testing::Values(IcpObjective::point_to_point,
                                           IcpObjective::point_to_plane, IcpObjective::coloured));

TEST(Icp, LeavesWhatAPlaneDoesNotDetermine) {
  IcpOptions options;
  const RigidTransform off{rotation_exp({0.1, 0, 0}), {0, 0, 0.05}};
  const IcpResult result = icp(board(20), board(20), off, options);
  EXPECT_EQ(result.determined, 3);
  // Out of the plane it settles; in it, where sliding costs nothing, it stays.
  const Eigen::Vector3d normal = result.target_from_source.rotation.col(2);
  EXPECT_NEAR(normal.z(), 1, 1e-12);
  EXPECT_NEAR(result.target_from_source.translation.z(), 0, 1e-9);
  EXPECT_LT(result.target_from_source.translation.norm(), 0.01);
  EXPECT_LT(std::abs(rotation_log(result.target_from_source.rotation).z()), 1e-6);
}

TEST(Icp, ColourDeterminesWhatAPlaneLeavesOpen) {
  const RigidTransform truth{rotation_exp({0.05, 0.02, 0.2}), {0.06, -0.03, 0.04}};
  IcpOptions options;
  options.objective = IcpObjective::coloured;
  options.max_distance_m = 1;
  options.gradient_radius_m = 0.1;
  options.max_iterations = 200;
  options.settled_change = 0;
  for (const ColourWeighting weighting :
       {ColourWeighting::published, ColourWeighting::inverse_variance}) {
    options.weighting = weighting;
    const IcpResult result = icp(board(40), moved(truth.inverse(), board(40)), {}, options);
    EXPECT_EQ(result.determined, 6);
    expect_near(result.target_from_source, truth, 1e-3, 1e-3);
  }
}

TEST(Icp, MatchesOffsetAndGainOfTheIntensities) {
  Cloud source = board(40);
  for (float& value : source.intensity) value = 300 * value + 40;
  const RigidTransform truth{rotation_exp({0, 0, 0.1}), {0.03, -0.02, 0}};
  source = moved(truth.inverse(), source);
  IcpOptions options;
  options.objective = IcpObjective::coloured;
  options.max_distance_m = 1;
  options.gradient_radius_m = 0.1;
  options.match_intensity = true;
  options.max_iterations = 100;
  options.settled_change = 0;
  const IcpResult result = icp(board(40), source, {}, options);
  expect_near(result.target_from_source, truth, 2e-3, 2e-3);
  EXPECT_NEAR(result.gain, 1 / 300.0, 1e-4);
}

TEST(Icp, TrimmingAndKernelsWithstandAStrayObject) {
  Cloud source = corner(30);
  for (std::size_t i = 0; i < 300; ++i) {  // a shelf that the target does not have
    source.positions.emplace_back(0.3 + 0.001 * static_cast<double>(i), 0.5, 0.08);
    source.normals.emplace_back(0, 0, 1);
    source.intensity.push_back(0);
  }
  const RigidTransform truth = motion(1 * deg, {0.005, -0.004, 0.003});
  source = moved(truth.inverse(), source);
  const auto error = [&](const IcpOptions& options) {
    const IcpResult result = icp(corner(30), source, {}, options);
    return (result.target_from_source.translation - truth.translation).norm();
  };
  IcpOptions plain, trimmed, tukey;
  trimmed.trim_share = 0.12;
  tukey.kernel = RobustKernel::tukey;
  EXPECT_GT(error(plain), 2e-3);
  EXPECT_LT(error(trimmed), 1e-4);
  EXPECT_LT(error(tukey), 1e-4);
}

TEST(Icp, NormalsThatDisagreeMakeNoPair) {
  // A thin wall scanned from both sides: only the near face may pair with the near face.
  Cloud thin = board(20), cross = board(20);
  for (Eigen::Vector3f& n : cross.normals) n = Eigen::Vector3f(1, 0, 0);
  IcpOptions options;
  options.normal_angle_rad = 30 * deg;
  EXPECT_EQ(icp(thin, cross, {}, options).stop, IcpStop::too_few_pairs);
  options.normal_angle_rad = std::numbers::pi;
  EXPECT_EQ(icp(thin, cross, {}, options).pairs, cross.size());
}

TEST(Icp, SaysWhyItStopped) {
  IcpOptions options;
  options.max_distance_m = 0.1;
  EXPECT_EQ(icp(corner(10), corner(10), {Eigen::Matrix3d::Identity(), {9, 9, 9}}, options).stop,
            IcpStop::too_few_pairs);
  options.max_iterations = 1;
  const IcpResult limited = icp(corner(10), corner(10), motion(5 * deg, {0, 0, 0}), options);
  EXPECT_EQ(limited.stop, IcpStop::iteration_limit);
  EXPECT_EQ(limited.iterations, 1);
  EXPECT_FALSE(limited.converged());
}

// The covariance that the information gives, against the scatter of 200 runs with noise of its own.
TEST(Icp, InformationIsTheInverseOfTheScatter) {
  const Cloud target = corner(24);
  constexpr int runs = 200;
  double sum = 0;
  for (int run = 0; run < runs; ++run) {
    const IcpResult result = icp(target, corner(24, 0.003, 100 + run), {}, {});
    const Vector6d off = left_difference({}, result.target_from_source, result.information_about_m);
    sum += off.dot(result.information * off);
  }
  EXPECT_NEAR(sum / (6 * runs), 1, 4 * std::sqrt(2.0 / (6 * runs)));
}

TEST(Icp, NamesWhatIsMissingOrOutOfRange) {
  Cloud bare = board(5);
  bare.normals.clear();
  EXPECT_THROW(icp(bare, bare, {}, {}), Error);
  Cloud grey = board(5);
  grey.intensity.clear();
  IcpOptions coloured;
  coloured.objective = IcpObjective::coloured;
  EXPECT_THROW(icp(grey, board(5), {}, coloured), Error);
  EXPECT_THROW(icp(board(5), grey, {}, coloured), Error);
  EXPECT_THROW(icp(Cloud{}, board(5), {}, {}), Error);
  EXPECT_THROW(icp(board(5), Cloud{}, {}, {}), Error);
  IcpOptions bad;
  bad.trim_share = 1;
  EXPECT_THROW(icp(board(5), board(5), {}, bad), Error);
}

}  // namespace
}  // namespace alea
