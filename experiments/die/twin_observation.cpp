#include "experiments/die/twin_observation.hpp"

#include <algorithm>
#include <cmath>

#include "alea/facet/plane_fit.hpp"
#include "alea/simulate/scanner.hpp"
#include "alea/sphere/sphere_fit.hpp"

namespace alea::experiments::die {
namespace {

struct Sight {
  const Twin& twin;
  int scan = 0;
  SimulationKey key;

  const RigidTransform& scene_from_scan() const { return twin.scene_from_scan[scan]; }
};

ObservedDie fit_facets_of(const SimulatedScan& scan, const Twin& twin, int number,
                          FitMethod method) {
  std::array<int, 3> pips{twin.top, twin.side, number == 0 ? twin.master_facet : twin.slave_facet};
  std::sort(pips.begin(), pips.end());
  PlaneFitOptions options;
  options.method = method;
  ObservedDie observed;
  for (int k = 0; k < 3; ++k) {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < scan.truth.size(); ++i)
      if (scan.truth[i].surface.facet == pips[k]) points.push_back(scan.cloud.positions[i]);
    observed.facets[k].pips = pips[k];
    observed.facets[k].fit = fit_plane(points, options);
  }
  return observed;
}

PlaneMoments observe_plane(const TwinPlane& plane, const Sight& sight, std::uint32_t index,
                           double points) {
  Scene scene;
  scene.patches.push_back(plane.patch);
  const Eigen::Vector3d away = centre_of(plane.patch) - sight.scene_from_scan().translation;
  const double cosine = std::abs(plane_of(plane.patch).normal.dot(away.normalized()));
  const double side_m = plane.patch.side_u_m.norm();
  const double step_rad = side_m / away.norm() * std::sqrt(cosine / points);
  const RandomStream phase({sight.key.seed, sight.key.experiment, sight.key.trial,
                            100 + 2 * index + sight.key.scan, Purpose::scene_layout});
  const auto [azimuth, elevation] = phase.uniform2_at(0);
  Station station = aimed_station(sight.scene_from_scan(), bounding_ball(plane.patch), step_rad,
                                  {azimuth, elevation});
  NoiseModel& noise = station.scanner.noise;
  noise.range_noise_m *= plane.noise_scale;
  noise.grazing_m *= plane.noise_scale;
  noise.surface_m *= plane.noise_scale;
  SimulationKey key = sight.key;
  key.scan = 100 + 2 * index + sight.key.scan;
  return plane_moments(simulate_scan(scene, station, key).positions);
}

Eigen::Vector3d observe_sphere(const Sphere& sphere, const Sight& sight, std::uint32_t index) {
  Scene scene;
  scene.spheres.push_back(sphere);
  const Station station = aimed_station(sight.scene_from_scan(), bounding_ball(sphere), 3e-4);
  SimulationKey key = sight.key;
  key.scan = 200 + 2 * index + sight.key.scan;
  const Cloud cloud = simulate_scan(scene, station, key);
  SphereFitOptions options;
  options.radius_m = sphere.radius_m;
  const Eigen::Vector3d start = sight.scene_from_scan().inverse() * sphere.centre_m;
  const Result<SphereFit> fit = fit_sphere(cloud.positions, start, options);
  return fit ? fit->centre_m : Eigen::Vector3d::Constant(std::nan(""));
}

}  // namespace

TwinObservation observe_twin(const Twin& twin, std::uint64_t seed, std::uint64_t trial,
                             double plane_points) {
  TwinObservation observed;
  observed.planes.resize(twin.planes.size());
  const auto experiment = static_cast<std::uint32_t>(twin.dataset.front());
  for (int number = 0; number < 2; ++number) {
    const auto scan = static_cast<std::uint32_t>(number);
    const Sight sight{twin, number, {seed, experiment, trial, scan}};
    Scene scene;
    scene.dice.push_back(twin.die);
    const Station station =
        aimed_station(sight.scene_from_scan(), bounding_ball(twin.die), twin.step_rad[number]);
    const SimulatedScan die = simulate_scan_with_truth(scene, station, sight.key);
    observed.die_points[number] = die.cloud.size();
    observed.along_ray[number] = fit_facets_of(die, twin, number, FitMethod::along_ray);
    observed.orthogonal[number] = fit_facets_of(die, twin, number, FitMethod::orthogonal);
    for (std::uint32_t k = 0; k < twin.planes.size(); ++k)
      (number == 0 ? observed.planes[k].master : observed.planes[k].slave) =
          observe_plane(twin.planes[k], sight, k, plane_points);
    for (std::uint32_t k = 0; k < twin.spheres.size(); ++k)
      observed.centres_m[number].push_back(observe_sphere(twin.spheres[k], sight, k));
  }
  return observed;
}

}  // namespace alea::experiments::die
