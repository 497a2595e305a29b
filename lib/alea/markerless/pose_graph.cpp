#include "alea/markerless/pose_graph.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <array>

#include "alea/core/error.hpp"
#include "alea/markerless/loop_closure.hpp"
#include "alea/markerless/selected_inverse.hpp"

namespace alea {
namespace {

/// Axis times angle (rad), then translation (m).
using Block = std::array<double, 6>;

Block block_of(const RigidTransform& pose) {
  const Eigen::Vector3d turn = rotation_log(pose.rotation);
  return {turn.x(),
          turn.y(),
          turn.z(),
          pose.translation.x(),
          pose.translation.y(),
          pose.translation.z()};
}

RigidTransform pose_of(const Block& block) {
  return {rotation_exp({block[0], block[1], block[2]}), {block[3], block[4], block[5]}};
}

/// Measured minus predicted pose of b in a, as a left perturbation in a's frame, in standard
/// deviations.
struct EdgeResidual {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  Matrix6d weight;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    Eigen::Matrix<T, 3, 3> of_a, of_b;
    ceres::AngleAxisToRotationMatrix(a, of_a.data());
    ceres::AngleAxisToRotationMatrix(b, of_b.data());
    const Vector between = Eigen::Map<const Vector>(b + 3) - Eigen::Map<const Vector>(a + 3);
    const Eigen::Matrix<T, 3, 3> predicted = of_a.transpose() * of_b;
    const Eigen::Matrix<T, 3, 3> off = rotation.cast<T>() * predicted.transpose();
    Eigen::Matrix<T, 6, 1> difference;
    ceres::RotationMatrixToAngleAxis(off.data(), difference.data());
    difference.template tail<3>() = translation.cast<T>() - off * (of_a.transpose() * between);
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = weight.cast<T>() * difference;
    return true;
  }
};

Matrix6d weight_of(const Matrix6d& covariance) {
  // L^-1 with covariance = L L'.
  return covariance.llt().matrixL().solve(Matrix6d(Matrix6d::Identity()));
}

void require_valid(std::size_t stations, const std::vector<PoseEdge>& edges) {
  for (const PoseEdge& edge : edges)
    if (edge.a == edge.b || edge.a >= stations || edge.b >= stations)
      throw usage_error(
          fmt::format("pose graph: edge {}-{} of {} stations", edge.a, edge.b, stations));
}

/// A left perturbation of b's pose in the network, seen in a's frame: both ends of an edge move the
/// residual by their difference. Blocks of the inverse normal matrix, about each station.
std::vector<Matrix6d> covariances_of(const std::vector<RigidTransform>& poses,
                                     const std::vector<PoseEdge>& edges,
                                     const std::vector<bool>& accepted,
                                     const PoseGraphOptions& options) {
  const auto free = static_cast<Eigen::Index>(6 * (poses.size() - 1));
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::size_t i, std::size_t j, const Matrix6d& block) {
    if (i == 0 || j == 0) return;  // the first station is fixed
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c)
        entries.emplace_back(static_cast<int>(6 * (i - 1)) + r, static_cast<int>(6 * (j - 1)) + c,
                             block(r, c));
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!accepted[e]) continue;
    const PoseEdge& edge = edges[e];
    // d(residual) = J_a delta_a - J_b delta_b; deltas turn the network frame about the station.
    const Eigen::Matrix3d back = poses[edge.a].rotation.transpose();
    const auto jacobian = [&](std::size_t station) {
      const Eigen::Vector3d arm = poses[station].translation - poses[edge.a].translation;
      Matrix6d j = Matrix6d::Zero();
      j.topLeftCorner<3, 3>() = back;
      j.bottomRightCorner<3, 3>() = back;
      j.bottomLeftCorner<3, 3>() = back * skew(arm);
      return j;
    };
    const Matrix6d weight = weight_of(grown_covariance(edge, options));
    const Matrix6d of_a = weight * jacobian(edge.a), of_b = weight * jacobian(edge.b);
    add(edge.a, edge.a, of_a.transpose() * of_a);
    add(edge.b, edge.b, of_b.transpose() * of_b);
    add(edge.a, edge.b, -of_a.transpose() * of_b);
    add(edge.b, edge.a, -of_b.transpose() * of_a);
  }
  Eigen::SparseMatrix<double> normal_matrix(free, free);
  normal_matrix.setFromTriplets(entries.begin(), entries.end());
  std::vector<Matrix6d> covariances = inverse_diagonal_blocks(normal_matrix);
  covariances.insert(covariances.begin(), Matrix6d::Zero());
  return covariances;
}

}  // namespace

Result<PoseGraph> solve_pose_graph(std::size_t stations, const std::vector<PoseEdge>& edges,
                                   const PoseGraphOptions& options) {
  require_valid(stations, edges);
  if (stations == 0) throw usage_error("pose graph: no stations");
  const LoopClosure closure = close_loops(stations, edges, options);
  for (std::size_t s = 0; s < stations; ++s)
    if (!closure.reached[s])
      return Refusal{RefusalCode::no_match,
                     fmt::format("station {} has no accepted connection to the first one; add a "
                                 "station between them",
                                 s + 1)};
  PoseGraph graph;
  std::vector<Block> blocks;
  for (const RigidTransform& pose : closure.network_from_scan) blocks.push_back(block_of(pose));
  ceres::Problem problem;
  for (Block& block : blocks) problem.AddParameterBlock(block.data(), 6);
  problem.SetParameterBlockConstant(blocks[0].data());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!closure.accepted[e]) {
      graph.rejected.push_back(e);
      continue;
    }
    const PoseEdge& edge = edges[e];
    const Matrix6d weight = weight_of(grown_covariance(edge, options));
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<EdgeResidual, 6, 6, 6>(
            new EdgeResidual{edge.a_from_b.rotation, edge.a_from_b.translation, weight}),
        new ceres::CauchyLoss(3.0), blocks[edge.a].data(), blocks[edge.b].data());
  }
  if (problem.NumResidualBlocks() > 0) {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    solver.max_num_iterations = options.max_iterations;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    graph.iterations = static_cast<int>(summary.iterations.size());
    graph.chi_square = 2 * summary.final_cost;
  }
  for (const Block& block : blocks) graph.network_from_scan.push_back(pose_of(block));
  if (stations > 1)
    graph.covariance = covariances_of(graph.network_from_scan, edges, closure.accepted, options);
  else
    graph.covariance = {Matrix6d::Zero()};
  return graph;
}

}  // namespace alea
