#include "experiments/die/twin_bound.hpp"

#include <cmath>

#include "alea/evaluate/fisher_bound.hpp"

namespace alea::experiments::die {
namespace {

FisherScene bound_scene(const Twin& twin) {
  FisherScene scene;
  for (int scan = 0; scan < 2; ++scan) {
    FisherStation station;
    station.scene_from_scan = twin.scene_from_scan[scan];
    station.step_rad = twin.step_rad[scan];
    scene.stations.push_back(station);
  }
  std::vector<Plane> planes;
  for (const DieFacet& facet : twin.die.facets) planes.push_back(facet.plane);
  FisherBody body = free_body(planes);
  body.edges.push_back(shared_edge(body, scene.stations[0], scene.stations[1]));
  scene.bodies.push_back(body);
  return scene;
}

/// How the offset of a plane follows the left perturbation of master_from_slave about `about_m`
/// (master frame).
Vector6d offset_row(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& normal,
                    const Eigen::Vector3d& about_m) {
  Vector6d row;
  row << (centre_m - about_m).cross(normal), normal;
  return row;
}

}  // namespace

void add_plane_bounds(const Twin& twin, const TwinObservation& observed, TwinOutcome& outcome) {
  const FisherBound bound = fisher_bound(bound_scene(twin));
  const Eigen::Vector3d target(0, 0, twin.true_edge_m / 2);
  const Result<TransformCovariance> pose = relative_covariance(bound, 0, 1, target);
  if (!pose) return;
  const RigidTransform master_from_scene = twin.scene_from_scan[0].inverse();
  const Eigen::Vector3d edge = master_from_scene.rotation * twin.edge_direction;
  const auto row_of = [&](const TwinPlane& plane) {
    return offset_row(master_from_scene * centre_of(plane.patch),
                      master_from_scene.rotation * plane_of(plane.patch).normal, pose->about_m);
  };

  // The length is a weighted sum of the independent planes' offsets, each over its share of the
  // edge; its variance has the planes' own noise and that of the pose.
  double information = 0, noise_variance = 0;
  Vector6d length_row = Vector6d::Zero();
  for (std::size_t k = 0; k < twin.planes.size(); ++k) {
    if (twin.planes[k].check) continue;
    const auto& [master, slave] = observed.planes[k];
    const double share =
        (master_from_scene.rotation * plane_of(twin.planes[k].patch).normal).dot(edge);
    const double total = master.count + slave.count;
    const double weight = master.count * slave.count / (total * total);
    const double master_m = fit_rmse_m(master), slave_m = fit_rmse_m(slave);
    information += weight * share * share;
    length_row += weight * share * row_of(twin.planes[k]);
    noise_variance += weight * weight * share * share *
                      (master_m * master_m / master.count + slave_m * slave_m / slave.count);
  }
  const double length_variance = (noise_variance + length_row.dot(pose->covariance * length_row)) /
                                 (information * information);

  std::size_t check = 0;
  for (const TwinPlane& plane : twin.planes) {
    if (!plane.check) continue;
    const Vector6d row = row_of(plane);
    const double variance = row.dot(pose->covariance * row);
    const double share = (master_from_scene.rotation * plane_of(plane.patch).normal).dot(edge);
    outcome.planes[check].bound_m = std::sqrt(variance);
    outcome.planes[check].widened_bound_m = std::sqrt(variance + share * share * length_variance);
    ++check;
  }
}

}  // namespace alea::experiments::die
