#include "experiments/die/efficiency_trial.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "alea/core/parallel.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "alea/facet/pointing.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/facet_met.hpp"

namespace alea::experiments::die {
namespace {

constexpr std::uint32_t efficiency_number = 21;

Die draw_die(const EfficiencyCase& setting, std::uint64_t seed, std::uint64_t trial) {
  DieModel model;
  model.size_m.setConstant(setting.edge_m);
  model.pips.painted = false;
  model.edge_radius_m = setting.edge_radius_m;
  for (FacetShape& facet : model.facets) facet.bow_m = setting.bow_m;
  model.scene_from_die.translation.z() = setting.edge_m / 2;  // on the floor z = 0, 1 up
  return build_die(
      with_random_shape(model, {setting.tilt_sd_rad, 0, 0}, seed, efficiency_number, trial));
}

std::vector<RigidTransform> station_poses(const EfficiencyCase& setting) {
  DieBoundCase geometry;
  geometry.edge_m = setting.edge_m;
  geometry.range_m = setting.range_m;
  geometry.step_rad = setting.step_rad;
  std::vector<RigidTransform> poses;
  for (const FisherStation& station : die_bound_scene(geometry).stations)
    poses.push_back(station.scene_from_scan);
  return poses;
}

/// True planes of the facets that a scan sees, in its frame, ascending in pips.
ObservedDie seen_truth(const Die& die, const RigidTransform& scene_from_scan) {
  DieShape shape;
  for (int f = 0; f < 6; ++f) shape.facets[f] = die.body.planes[f];
  return observe_exactly(shape, facing_pips(shape, scene_from_scan.translation),
                         scene_from_scan.inverse());
}

std::array<std::vector<Eigen::Vector3d>, 3> members_by_rays(const Cloud& cloud,
                                                            const std::array<Plane, 3>& planes) {
  std::array<std::vector<Eigen::Vector3d>, 3> members;
  for (auto& facet : members) facet.reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.positions) members[facet_met(p, planes)].push_back(p);
  return members;
}

/// The facet of a convex die that a ray enters by: of those that face the scanner, the one met
/// last.
std::size_t facet_entered(const Eigen::Vector3d& scanner, const Eigen::Vector3d& ray,
                          const Die& die) {
  std::size_t facet = 0;
  double farthest = 0;
  for (std::size_t f = 0; f < die.body.planes.size(); ++f) {
    const Plane& plane = die.body.planes[f];
    const double height = plane.signed_distance(scanner), share = -height / plane.normal.dot(ray);
    if (height <= 0 || share <= farthest) continue;
    facet = f;
    farthest = share;
  }
  return facet;
}

/// The scan without rays whose own pointing decides what they meet, and without those that meet a
/// facet nearer to its borders than `radius_m`. The reported ray and the true die tell, so that no
/// noise has a say.
Cloud away_from_borders(const Cloud& cloud, const Die& die, const RigidTransform& scene_from_scan,
                        double radius_m) {
  const NoiseModel noise;
  const Eigen::Vector3d scanner = scene_from_scan.translation;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d measured = scene_from_scan.rotation * cloud.positions[i];
    const std::size_t facet = facet_entered(scanner, measured, die);
    const Eigen::Vector3d normal = die.body.planes[facet].normal;
    const Eigen::Vector3d ray =
        -die.body.planes[facet].signed_distance(scanner) / normal.dot(measured) * measured;
    bool inside = true;
    for (std::size_t other = 0; inside && other < die.body.planes.size(); ++other) {
      const Plane& border = die.body.planes[other];
      inside =
          other == facet ||
          -border.signed_distance(scanner + ray) >
              std::max(radius_m, border_pointing_sds * pointing_sd_m(ray, normal, border.normal,
                                                                     noise.angular_noise_rad));
    }
    if (inside) kept.push_back(i);
  }
  return subset(cloud, kept);
}

void shift(PlaneFit& fit, double offset_m) {
  fit.centroid_m += offset_m * fit.plane.normal;
  fit.plane.offset_m += offset_m;
}

/// First planes from members that know the truth, then fits to members by what was measured alone.
std::array<PlaneFit, 3> fit_by_rays(const Cloud& cloud, const std::array<Plane, 3>& truth,
                                    const PlaneFitOptions& options) {
  const auto first_members = members_by_rays(cloud, truth);
  std::array<Plane, 3> first;
  for (int k = 0; k < 3; ++k) first[k] = improve_plane(first_members[k], truth[k], options);
  const auto members = members_by_rays(cloud, first);
  return {fit_plane(members[0], first[0], options), fit_plane(members[1], first[1], options),
          fit_plane(members[2], first[2], options)};
}

struct ScanResult {
  ObservedDie die;
  double top_tilt_rad = 0;
};

ScanResult observe(const Scene& scene, const EfficiencyCase& setting,
                   const RigidTransform& scene_from_scan, const SimulationKey& key) {
  const RandomStream phases({key.seed, key.experiment, key.trial, key.scan, Purpose::station});
  const auto [column, row] = phases.uniform2_at(0);
  const Station station =
      aimed_station(scene_from_scan, bounding_ball(scene.dice[0]), setting.step_rad, {column, row});
  const Cloud cloud = away_from_borders(simulate_scan(scene, station, key), scene.dice[0],
                                        scene_from_scan, setting.edge_radius_m);
  const ObservedDie truth = seen_truth(scene.dice[0], scene_from_scan);
  PlaneFitOptions options;
  options.method = setting.fit;
  const auto fits = fit_by_rays(cloud, planes_of(truth), options);
  ScanResult result{truth, 0};
  RandomStream biases({key.seed, key.experiment, key.trial, key.scan, Purpose::experiment});
  for (int k = 0; k < 3; ++k) {
    result.die.facets[k].fit = fits[k];
    if (setting.facet_bias_sd_m > 0)
      shift(result.die.facets[k].fit, setting.facet_bias_sd_m * biases.normal());
  }
  // The upper facet has one pip, so it comes first.
  Eigen::Vector3d to_scanner = -fits[0].centroid_m;
  to_scanner.z() = 0;
  result.top_tilt_rad =
      (fits[0].plane.normal - truth.facets[0].fit.plane.normal).dot(to_scanner.normalized());
  return result;
}

}  // namespace

ObservedPair observe_pair(const EfficiencyCase& setting, std::uint64_t seed, std::uint64_t trial) {
  const Die die = draw_die(setting, seed, trial);
  const auto poses = station_poses(setting);
  Scene scene;
  scene.dice.push_back(die);
  const ScanResult master = observe(scene, setting, poses[0], {seed, efficiency_number, trial, 0});
  const ScanResult slave = observe(scene, setting, poses[1], {seed, efficiency_number, trial, 1});
  ObservedPair out;
  out.master = master.die;
  out.slave = slave.die;
  for (int f = 0; f < 6; ++f) out.shape.facets[f] = die.body.planes[f];
  const RigidTransform scan_from_scene = poses[0].inverse();
  out.master_from_slave = scan_from_scene * poses[1];
  out.centre_m = scan_from_scene * Eigen::Vector3d(0, 0, setting.edge_m / 2);
  const auto shared = shared_pips(master.die, slave.die);
  out.shared_edge_m = edge_length_m(die.body, shared.at(0), shared.at(1));
  out.top_tilt_rad = (master.top_tilt_rad + slave.top_tilt_rad) / 2;
  return out;
}

EfficiencyTrial run_efficiency_trial(const EfficiencyCase& setting, std::uint64_t seed,
                                     std::uint64_t trial) {
  const ObservedPair pair = observe_pair(setting, seed, trial);
  EfficiencyTrial out;
  ClosedFormOptions options;
  options.edge_m = pair.shared_edge_m;
  options.covariance_about_m = pair.centre_m;
  const auto found = register_closed_form(pair.master, pair.slave, options);
  out.refused = !found;
  if (!found) return out;
  const RigidTransform& truth = pair.master_from_slave;
  const Vector6d error = left_difference(truth, found->master_from_slave, pair.centre_m);
  out.rotation_rad = error.head<3>().norm();
  out.translation_m =
      (found->master_from_slave * (truth.inverse() * pair.centre_m) - pair.centre_m).norm();
  out.nees = error.dot(found->covariance.covariance.ldlt().solve(error));
  out.misclosure_chi_square = found->misclosure_chi_square;
  out.top_tilt_rad = pair.top_tilt_rad;
  out.least_variance_factor = 1e300;
  for (const ObservedDie* die : {&pair.master, &pair.slave})
    for (const ObservedFacet& facet : die->facets) {
      out.least_variance_factor = std::min(out.least_variance_factor, facet.fit.variance_factor);
      out.largest_variance_factor =
          std::max(out.largest_variance_factor, facet.fit.variance_factor);
    }
  return out;
}

std::vector<EfficiencyTrial> run_efficiency(const EfficiencyCase& setting, std::uint64_t seed,
                                            std::size_t trials) {
  std::vector<EfficiencyTrial> results(trials);
  parallel_chunks(trials, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t trial = begin; trial < end; ++trial)
      results[trial] = run_efficiency_trial(setting, seed, trial);
  });
  return results;
}

}  // namespace alea::experiments::die
