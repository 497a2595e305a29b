#include "experiments/die/sweep_comparators.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/angle.hpp"
#include "alea/die/plane_match.hpp"
#include "alea/simulate/scanner.hpp"
#include "alea/sphere/sphere_registration.hpp"
#include "experiments/die/sweep_die.hpp"

namespace alea::experiments::die {
namespace {

constexpr double sphere_radius_m = 0.0725;
// Numbers of the comparators' scans begin here, so that they share none with the die's.
constexpr std::uint32_t first_sphere_scan = 100, first_plane_scan = 200;

std::vector<Eigen::Vector3d> sphere_places() {
  const std::array<double, 6> azimuth_deg{3, 64, 118, 185, 239, 307};
  const std::array<double, 6> height_m{0.5, 1.1, 0.7, 1.3, 0.6, 0.9};
  std::vector<Eigen::Vector3d> places;
  for (std::size_t k = 0; k < azimuth_deg.size(); ++k)
    places.emplace_back(4 * std::cos(azimuth_deg[k] * deg), 4 * std::sin(azimuth_deg[k] * deg),
                        height_m[k]);
  return places;
}

Patch patch_about(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& u,
                  const Eigen::Vector3d& v, double side_m) {
  Patch patch;
  patch.side_u_m = side_m * u.normalized();
  patch.side_v_m = side_m * v.normalized();
  patch.corner_m = centre_m - (patch.side_u_m + patch.side_v_m) / 2;
  return patch;
}

/// An upright patch whose normal looks `heading_deg` from scene +y towards +x.
Patch wall(const Eigen::Vector3d& centre_m, double heading_deg) {
  const double heading = heading_deg * deg;
  return patch_about(centre_m, {-std::cos(heading), std::sin(heading), 0}, Eigen::Vector3d::UnitZ(),
                     0.8);
}

/// In front of both stations where these are a quarter turn apart.
std::vector<Patch> calibration_patches() {
  return {wall({-1.5, -2.0, 1.2}, 40), wall({0.4, -2.5, 1.1}, 0), wall({2.0, -1.5, 1.0}, -40),
          patch_about({-0.2, 2.5, 0.0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 0.6)};
}

Station aimed(const SweepSight& sight, int scan, const BoundingBall& ball, std::uint32_t number) {
  const RandomStream phases(
      {sight.seed, sweep_experiment_number, sight.trial, number, Purpose::station});
  const auto [column, row] = phases.uniform2_at(0);
  Station station = aimed_station(sight.setting.scene_from_scan[scan], ball, sight.setting.step_rad,
                                  {column, row});
  station.scanner.noise = sight.setting.noise;
  return station;
}

SimulationKey key_of(const SweepSight& sight, std::uint32_t number) {
  return {sight.seed, sweep_experiment_number, sight.trial, number};
}

Result<SphereFit> fit_one_sphere(const SweepSight& sight, int scan, std::uint32_t k) {
  const Eigen::Vector3d place = sphere_places()[k];
  const std::uint32_t number = first_sphere_scan + 2 * k + static_cast<std::uint32_t>(scan);
  Scene scene;
  scene.spheres = {{"", place, sphere_radius_m, 0.9}};
  const Station station = aimed(sight, scan, bounding_ball(scene.spheres[0]), number);
  SphereFitOptions options;
  options.radius_m = sphere_radius_m;
  options.noise = sight.setting.noise;
  return fit_sphere(simulate_scan(scene, station, key_of(sight, number)).positions,
                    sight.setting.scene_from_scan[scan].inverse() * place, options);
}

Result<PlaneFit> fit_one_patch(const SweepSight& sight, int scan, std::uint32_t k) {
  const std::uint32_t number = first_plane_scan + 2 * k + static_cast<std::uint32_t>(scan);
  Scene scene;
  scene.patches = {calibration_patches()[k]};
  const Station station = aimed(sight, scan, bounding_ball(scene.patches[0]), number);
  const Cloud cloud = simulate_scan(scene, station, key_of(sight, number));
  if (cloud.size() < 30)
    return Refusal{RefusalCode::too_few_points, "a calibration plane has fewer than 30 points"};
  PlaneFitOptions options;
  options.noise = sight.setting.noise;
  return fit_plane(cloud.positions, options);
}

/// Generalised least squares of pairs of planes, from a start that is nearly right.
RigidTransform match_all(const std::vector<std::array<PlaneFit, 2>>& pairs,
                         const RigidTransform& start) {
  RigidTransform estimate = start;
  const auto rows = static_cast<Eigen::Index>(3 * pairs.size());
  for (int step = 0; step < 6; ++step) {
    Misclosures m{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, 6),
                  Eigen::MatrixXd::Zero(rows, rows)};
    Eigen::Index row = 0;
    for (const auto& [master, slave] : pairs) {
      const PlaneMatch match = match_planes(master, slave, estimate);
      m.value.segment<3>(row) = match.residual;
      m.by_unknowns.middleRows<3>(row) = match.by_transform;
      m.covariance.block<3, 3>(row, row) =
          match.by_source * slave.covariance * match.by_source.transpose() + master.covariance;
      row += 3;
    }
    const Vector6d correction = solve_misclosures(m).correction;
    estimate = perturb_left(estimate, correction, Eigen::Vector3d::Zero());
    if (correction.norm() < 1e-11) break;
  }
  return estimate;
}

SweepBound bound_of_scene(const DieCase& setting, FisherScene scene) {
  scene.noise = setting.noise;
  for (const RigidTransform& pose : setting.scene_from_scan)
    scene.stations.push_back({pose, setting.step_rad, unknown_sd});
  const auto covariance =
      relative_covariance(fisher_bound(scene), 0, 1, {0, 0, setting.edge_m / 2});
  return covariance ? bound_from(setting, *covariance) : SweepBound{};
}

}  // namespace

Result<RigidTransform> by_spheres(const SweepSight& sight) {
  std::array<std::vector<SphereFit>, 2> fits;
  std::vector<SpherePair> pairs;
  for (std::uint32_t k = 0; k < sphere_places().size(); ++k) {
    const auto master = fit_one_sphere(sight, 0, k), slave = fit_one_sphere(sight, 1, k);
    if (!master || !slave) continue;
    const auto place = static_cast<std::uint32_t>(pairs.size());
    pairs.push_back({place, place});
    fits[0].push_back(*master);
    fits[1].push_back(*slave);
  }
  const auto result = register_sphere_pairs(fits[0], fits[1], pairs);
  if (!result) return result.refusal();
  return result->master_from_slave;
}

SweepBound spheres_bound(const DieCase& setting) {
  FisherScene scene;
  for (const Eigen::Vector3d& place : sphere_places())
    scene.spheres.push_back({place, sphere_radius_m, true});
  return bound_of_scene(setting, scene);
}

Result<RigidTransform> by_planes(const SweepSight& sight) {
  std::vector<std::array<PlaneFit, 2>> pairs;
  for (std::uint32_t k = 0; k < calibration_patches().size(); ++k) {
    const auto master = fit_one_patch(sight, 0, k), slave = fit_one_patch(sight, 1, k);
    if (!master) return master.refusal();
    if (!slave) return slave.refusal();
    pairs.push_back({*master, *slave});
  }
  return match_all(pairs,
                   sight.setting.scene_from_scan[0].inverse() * sight.setting.scene_from_scan[1]);
}

SweepBound planes_bound(const DieCase& setting) {
  FisherScene scene;
  for (const Patch& patch : calibration_patches()) {
    FisherFacet facet;
    facet.plane = plane_of(patch);
    facet.corners_m = {patch.corner_m, patch.corner_m + patch.side_u_m,
                       patch.corner_m + patch.side_u_m + patch.side_v_m,
                       patch.corner_m + patch.side_v_m};
    scene.bodies.push_back(calibration_plane(facet));
  }
  return bound_of_scene(setting, scene);
}

}  // namespace alea::experiments::die
