#include "experiments/die/sweep_observation.hpp"

#include <algorithm>
#include <cmath>

#include "alea/die/die_finder.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/facet_met.hpp"
#include "experiments/die/sweep_die.hpp"

namespace alea::experiments::die {
namespace {

using FacetSets = std::array<std::vector<Eigen::Vector3d>, 3>;

/// The facet whose plane is nearest to the measured point.
int facet_nearest(const Eigen::Vector3d& p, const std::array<Plane, 3>& planes) {
  int facet = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(planes[k].signed_distance(p)) < std::abs(planes[facet].signed_distance(p)))
      facet = k;
  return facet;
}

FacetSets sorted_points(const Cloud& cloud, const std::array<Plane, 3>& planes,
                        SelectionDomain domain) {
  FacetSets sets;
  for (auto& set : sets) set.reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.positions)
    sets[domain == SelectionDomain::ray ? facet_met(p, planes) : facet_nearest(p, planes)]
        .push_back(p);
  return sets;
}

/// First sorted by the true planes, then by what was measured alone.
Result<ObservedDie> observe_directly(const Cloud& cloud, const ObservedDie& truth,
                                     SelectionDomain domain, const PlaneFitOptions& options) {
  constexpr std::size_t least_points = 30;
  std::array<Plane, 3> planes = planes_of(truth);
  ObservedDie out = truth;
  for (const bool last : {false, true}) {
    const FacetSets sets = sorted_points(cloud, planes, domain);
    for (int k = 0; k < 3; ++k) {
      if (sets[k].size() < least_points)
        return Refusal{RefusalCode::too_few_points, "a facet has fewer than 30 points"};
      if (last)
        out.facets[k].fit = fit_plane(sets[k], planes[k], options);
      else
        planes[k] = improve_plane(sets[k], planes[k], options);
    }
  }
  return out;
}

PlaneFitOptions fit_options(const DieCase& setting, FitMethod method) {
  PlaneFitOptions options;
  options.method = method;
  options.noise = setting.noise;
  options.area_weights = setting.extraction.area_weights && method == FitMethod::along_ray;
  return options;
}

/// Finds the die among detected planes; which facet is which is told by the true planes.
Result<ObservedDie> detect_facets(const DieCase& setting, const Cloud& cloud,
                                  const ObservedDie& truth, const FacetFitOptions& facets) {
  DieFinderOptions options;
  options.edge_m = setting.edge_m;
  options.facets = facets;
  PlaneDetectionOptions detection;
  detection.detector = setting.extraction.detector;
  detection.tolerance_m = std::max(0.001, 4 * setting.noise.normal_sd_m(setting.range_m, 0.7));
  const auto dice = find_dice(cloud, detect_planes(cloud, detection), options);
  if (!dice) return dice.refusal();
  ObservedDie out = truth;
  for (ObservedFacet& facet : out.facets) {
    const auto& fits = dice->front().facets.fits;
    const auto nearest =
        std::max_element(fits.begin(), fits.end(), [&](const PlaneFit& a, const PlaneFit& b) {
          return a.plane.normal.dot(facet.fit.plane.normal) <
                 b.plane.normal.dot(facet.fit.plane.normal);
        });
    facet.fit = *nearest;
  }
  return out;
}

}  // namespace

DieScans scan_die(const DieCase& setting, std::uint64_t seed, std::uint64_t trial) {
  DieScans scans{draw_die(setting, seed, trial), {}};
  Scene scene;
  scene.dice.push_back(scans.die);
  if (!setting.extraction.direct) {
    Patch floor;
    const double half = 4 * setting.edge_m;
    floor.corner_m = {-half, -half, 0};
    floor.side_u_m = {2 * half, 0, 0}, floor.side_v_m = {0, 2 * half, 0};
    scene.patches.push_back(floor);
  }
  for (std::uint32_t scan = 0; scan < 2; ++scan) {
    const RandomStream phases({seed, sweep_experiment_number, trial, scan, Purpose::station});
    const auto [column, row] = phases.uniform2_at(0);
    Station station = aimed_station(setting.scene_from_scan[scan], bounding_ball(scans.die),
                                    setting.step_rad, {column, row});
    station.scanner.noise = setting.noise;
    scans.clouds[scan] =
        simulate_scan(scene, station, {seed, sweep_experiment_number, trial, scan});
  }
  return scans;
}

ObservedDie true_sight(const Die& die, const RigidTransform& scene_from_scan) {
  DieShape shape;
  for (int f = 0; f < 6; ++f) shape.facets[f] = die.body.planes[f];
  return observe_exactly(shape, facing_pips(shape, scene_from_scan.translation),
                         scene_from_scan.inverse());
}

Result<ObservedDie> observe_facets(const DieCase& setting, const DieScans& scans, int scan) {
  const ObservedDie truth = true_sight(scans.die, setting.scene_from_scan[scan]);
  const Extraction& extraction = setting.extraction;
  const PlaneFitOptions fit = fit_options(setting, extraction.fit);
  if (extraction.direct) return observe_directly(scans.clouds[scan], truth, extraction.domain, fit);
  FacetFitOptions facets;
  facets.fit = fit;
  facets.domain = extraction.domain;
  if (extraction.trim_m >= 0) facets.trim_m = extraction.trim_m;
  return detect_facets(setting, scans.clouds[scan], truth, facets);
}

Result<ObservedDie> observe_as_paper(const DieCase& setting, const DieScans& scans, int scan) {
  const ObservedDie truth = true_sight(scans.die, setting.scene_from_scan[scan]);
  const PlaneFitOptions fit = fit_options(setting, FitMethod::orthogonal);
  if (setting.extraction.direct)
    return observe_directly(scans.clouds[scan], truth, SelectionDomain::coordinate, fit);
  FacetFitOptions facets;
  facets.fit = fit;
  facets.trim_m = 0;
  return detect_facets(setting, scans.clouds[scan], truth, facets);
}

}  // namespace alea::experiments::die
