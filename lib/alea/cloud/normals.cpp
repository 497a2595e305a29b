#include "alea/cloud/normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "alea/cloud/neighbours.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

/// Unit eigenvector of the least eigenvalue of the neighbours' spread. Sums about the point itself,
/// so that a far origin costs no digits.
Eigen::Vector3d least_spread(const std::vector<KdPoint>& ordered, const Eigen::Vector3d& about,
                             std::span<const Neighbour> near) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Neighbour& neighbour : near) {
    const Eigen::Vector3d d = ordered[neighbour.index].position - about;
    sum += d;
    squares.noalias() += d * d.transpose();
  }
  const Eigen::Matrix3d spread =
      squares - sum * sum.transpose() / static_cast<double>(std::max<std::size_t>(near.size(), 1));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  return solver.eigenvectors().col(0);
}

}  // namespace

std::vector<Eigen::Vector3d> estimate_normals(const Cloud& cloud, const NormalOptions& options) {
  if (options.neighbours < 3)
    throw usage_error("normals: a normal needs at least three neighbours");
  const Eigen::Vector3d toward = options.toward.value_or(
      cloud.scanner_position.value_or(Eigen::Vector3d(Eigen::Vector3d::Zero())));
  const NeighbourIndex index(cloud.positions);
  std::vector<Eigen::Vector3d> normals(cloud.size());
  const std::vector<KdPoint>& ordered = index.order().points;
  parallel_chunks(ordered.size(), 4096, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> near(static_cast<std::size_t>(options.neighbours));
    for (std::size_t place = begin; place < end; ++place) {
      const KdPoint& point = ordered[place];
      const std::size_t count = index.nearest_places(point.position, near);
      const Eigen::Vector3d normal =
          least_spread(ordered, point.position, std::span(near).first(count));
      const bool away = normal.dot(toward - point.position) < 0;
      normals[point.index] = away ? Eigen::Vector3d(-normal) : normal;
    }
  });
  return normals;
}

}  // namespace alea
