#include "alea/evaluate/check_planes.hpp"

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

std::vector<Eigen::Vector3d> gather(const Cloud& cloud, std::span<const std::uint32_t> indices) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(indices.size());
  for (const std::uint32_t i : indices) points.push_back(cloud.positions[i]);
  return points;
}

double rmse_about(const Plane& plane, std::span<const Eigen::Vector3d> points) {
  double sum = 0;
  for (const Eigen::Vector3d& p : points) {
    const double residual = plane.signed_distance(p);
    sum += residual * residual;
  }
  return points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

CheckPlane evaluate_check_plane(const Cloud& master, const Cloud& slave, const CommonPlane& pair,
                                const RigidTransform& master_from_slave) {
  std::vector<Eigen::Vector3d> both = gather(master, pair.indices_master);
  std::vector<Eigen::Vector3d> moved = gather(slave, pair.indices_slave);
  for (Eigen::Vector3d& p : moved) p = master_from_slave * p;

  CheckPlane out;
  out.id = pair.id;
  out.centroid_m = pair.fit_master.centroid_m;
  out.normal = pair.fit_master.plane.normal;
  out.points_master = both.size();
  out.points_slave = moved.size();
  out.alone_master_m = pair.fit_master.rmse_m;
  out.alone_slave_m = pair.fit_slave.rmse_m;
  out.slave_to_master_m = rmse_about(pair.fit_master.plane, moved);

  Eigen::Vector3d slave_normal = master_from_slave.rotation * pair.fit_slave.plane.normal;
  if (slave_normal.dot(out.normal) < 0) slave_normal = -slave_normal;
  const Eigen::Vector3d slave_centroid = master_from_slave * pair.fit_slave.centroid_m;
  // Along the master's normal, from the master's centroid to the slave's plane.
  out.offset_m = slave_normal.dot(slave_centroid - out.centroid_m) / slave_normal.dot(out.normal);
  out.tilt_rad = std::atan2(slave_normal.cross(out.normal).norm(), slave_normal.dot(out.normal));

  both.insert(both.end(), moved.begin(), moved.end());
  out.union_m = orthogonal_rmse_m(both);
  return out;
}

}  // namespace alea
