#include "alea/markerless/prepared_scan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/cloud/normals.hpp"
#include "alea/cloud/sampling.hpp"
#include "alea/core/error.hpp"

namespace alea {
namespace {

constexpr double least_cell_m = 0.1, largest_cell_m = 0.8;

Cloud about(const Cloud& scan, const Eigen::Vector3d& origin) {
  Cloud moved;
  moved.positions.reserve(scan.size());
  for (const Eigen::Vector3d& p : scan.positions) moved.positions.push_back(p - origin);
  moved.scanner_position = Eigen::Vector3d::Zero();
  return moved;
}

/// The finest of a ladder of grids that leaves no more than `points`.
Cloud thinned(const Cloud& scan, std::size_t points, double& cell_m) {
  Cloud grid = grid_average(scan, cell_m = least_cell_m);
  while (grid.size() > points && cell_m < largest_cell_m) {
    cell_m *=
        std::max(1.1, std::sqrt(static_cast<double>(grid.size()) / static_cast<double>(points)));
    cell_m = std::min(std::ceil(cell_m * 20) / 20, largest_cell_m);
    grid = grid_average(scan, cell_m);
  }
  return grid;
}

/// The direction that most normals of near-horizontal surfaces share: the mode of those within 35
/// deg of z, floors and ceilings alike.
Eigen::Vector3d vertical(const Cloud& cloud) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  for (const double within_deg : {35.0, 15.0, 8.0, 4.0, 3.0, 3.0}) {
    const double least = std::cos(within_deg * std::numbers::pi / 180);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3f& n : cloud.normals) {
      const Eigen::Vector3d normal = n.cast<double>();
      const double along = normal.dot(up);
      if (std::abs(along) > least) sum += along > 0 ? normal : Eigen::Vector3d(-normal);
    }
    if (sum.norm() < 30) break;  // too little ground to tell
    up = sum.normalized();
  }
  return up;
}

}  // namespace

PreparedScan prepare_scan(const Cloud& scan, const PrepareOptions& options) {
  if (scan.empty()) throw usage_error("markerless: the scan has no points");
  const Eigen::Vector3d scanner =
      scan.scanner_position.value_or(Eigen::Vector3d(Eigen::Vector3d::Zero()));
  const Cloud local = about(scan, scanner);
  double cell_m = options.cell_m;
  Cloud fine = cell_m > 0 ? grid_average(local, cell_m) : thinned(local, options.points, cell_m);
  const NormalOptions normals{options.normal_neighbours, Eigen::Vector3d(Eigen::Vector3d::Zero())};
  for (const Eigen::Vector3d& n : estimate_normals(fine, normals))
    fine.normals.push_back(n.cast<float>());
  Cloud coarse = grid_average(fine, 3 * cell_m);
  Cloud probe = random_sample(coarse, 1500, 1);
  const Eigen::Matrix3d upright = options.levelled ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                                   : Eigen::Quaterniond::FromTwoVectors(
                                                         vertical(fine), Eigen::Vector3d::UnitZ())
                                                         .toRotationMatrix();
  const double image_deg = scan.size() > 100000 ? 1.0 : 1.5;
  RangeImage free_space(local, Eigen::Vector3d::Zero(), image_deg * std::numbers::pi / 180);
  NeighbourIndex index(fine.positions);
  SurfaceMap surfaces(fine, std::max(0.5, 3 * cell_m));
  return {scanner,           cell_m,           std::move(fine),
          std::move(coarse), std::move(probe), std::move(free_space),
          upright,           std::move(index), std::move(surfaces)};
}

}  // namespace alea
