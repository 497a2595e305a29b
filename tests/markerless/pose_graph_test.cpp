#include "alea/markerless/pose_graph.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"

namespace alea {
namespace {

std::vector<RigidTransform> ring(std::size_t stations) {
  std::vector<RigidTransform> poses;
  for (std::size_t s = 0; s < stations; ++s) {
    const double angle =
        2 * 3.14159265358979 * static_cast<double>(s) / static_cast<double>(stations);
    poses.push_back({rotation_exp({0.02 * std::sin(angle), 0.01, 2.5 * angle}),
                     {6 * std::cos(angle), 6 * std::sin(angle), 0.2 * std::cos(2 * angle)}});
  }
  const RigidTransform first = poses[0].inverse();
  for (RigidTransform& pose : poses) pose = first * pose;
  return poses;
}

PoseEdge edge(const std::vector<RigidTransform>& truth, std::size_t a, std::size_t b,
              RandomStream& stream) {
  Vector6d sd, off;
  sd << 2e-4, 2e-4, 2e-4, 0.003, 0.003, 0.003;
  for (int k = 0; k < 6; ++k) off[k] = sd[k] * stream.normal();
  PoseEdge out;
  out.a = a;
  out.b = b;
  out.a_from_b = perturb_left(truth[a].inverse() * truth[b], off, Eigen::Vector3d::Zero());
  out.covariance = sd.cwiseAbs2().asDiagonal();
  return out;
}

TEST(PoseGraph, RejectsSymmetricTwinsAndMeetsTheTruthWithinItsCovariance) {
  const auto truth = ring(8);
  RandomStream stream({21, 0, 0, 0, Purpose::test});
  std::vector<PoseEdge> edges;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = a + 1; b < 8; ++b) edges.push_back(edge(truth, a, b, stream));
  const std::vector<std::size_t> wrong{2, 9, 17, 20, 26};
  for (const std::size_t e : wrong)
    edges[e].a_from_b.rotation = rotation_exp({0, 0, 1.0471975512}) * edges[e].a_from_b.rotation;
  PoseGraphOptions options;
  options.rotation_floor_rad = options.translation_floor_m = 1e-9;
  const auto graph = solve_pose_graph(8, edges, options);
  ASSERT_TRUE(graph);
  EXPECT_EQ(graph->rejected, wrong);
  double nees = 0;
  for (std::size_t s = 1; s < 8; ++s) {
    const Vector6d off =
        left_difference(truth[s], graph->network_from_scan[s], truth[s].translation);
    nees += off.dot(graph->covariance[s].inverse() * off) / 7;
  }
  // Mean of seven correlated chi-squares of 6 degrees: far from 6 only if the covariance is wrong.
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 15);
}

TEST(PoseGraph, AChainWithoutLoopsIsTakenAsItIs) {
  const auto truth = ring(5);
  RandomStream stream({22, 0, 0, 0, Purpose::test});
  std::vector<PoseEdge> edges;
  for (std::size_t s = 0; s + 1 < 5; ++s) edges.push_back(edge(truth, s, s + 1, stream));
  const auto graph = solve_pose_graph(5, edges, {});
  ASSERT_TRUE(graph);
  EXPECT_TRUE(graph->rejected.empty());
  const RigidTransform chained =
      edges[0].a_from_b * edges[1].a_from_b * edges[2].a_from_b * edges[3].a_from_b;
  EXPECT_LT((graph->network_from_scan[4].translation - chained.translation).norm(), 1e-6);
}

TEST(PoseGraph, AStationWithoutConnectionIsRefused) {
  const auto truth = ring(4);
  RandomStream stream({23, 0, 0, 0, Purpose::test});
  const auto graph =
      solve_pose_graph(4, {edge(truth, 0, 1, stream), edge(truth, 1, 2, stream)}, {});
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.refusal().code, RefusalCode::no_match);
}

TEST(PoseGraph, AnEdgeToNowhereIsMisuse) {
  EXPECT_THROW(solve_pose_graph(2, {{0, 2, {}, Matrix6d::Identity()}}, {}), Error);
  EXPECT_THROW(solve_pose_graph(2, {{1, 1, {}, Matrix6d::Identity()}}, {}), Error);
}

}  // namespace
}  // namespace alea
