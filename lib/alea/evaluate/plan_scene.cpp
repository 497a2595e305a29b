#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/evaluate/fisher_information.hpp"
#include "alea/evaluate/plan.hpp"
#include "alea/simulate/die_ray.hpp"
#include "alea/simulate/mesh.hpp"
#include "alea/simulate/primitive_ray.hpp"

namespace alea {
namespace {

/// A surface that stands this little in front of a target's plane is the target itself (a bow).
constexpr double same_surface_m = 0.02;
constexpr double least_border_m = 0.01;  // as facet/facet_fit.hpp
constexpr double pip_share = 0.1;        // of the edge, as the registration masks them

template <typename Object>
void intersect_all(const std::vector<Object>& objects, const Ray& ray, Hit& hit) {
  for (std::uint32_t i = 0; i < objects.size(); ++i) intersect(objects[i], i, ray, hit);
}

bool hidden(const Scene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& x) {
  const double range_m = (x - eye).norm();
  const Ray ray{eye, (x - eye) / range_m};
  Hit hit;
  intersect_all(scene.dice, ray, hit);
  intersect_all(scene.patches, ray, hit);
  intersect_all(scene.boxes, ray, hit);
  intersect_all(scene.cylinders, ray, hit);
  intersect_all(scene.spheres, ray, hit);
  intersect_all(scene.checkerboards, ray, hit);
  intersect_all(scene.meshes, ray, hit);
  return hit.range_m < range_m - same_surface_m;
}

bool in_window(const Station& station, const Eigen::Vector3d& x) {
  const Eigen::Vector3d p = station.scene_from_scan.inverse() * x;
  const double range_m = p.norm(), elevation = std::asin(p.z() / range_m);
  if (range_m < station.scanner.min_range_m || range_m > station.scanner.max_range_m) return false;
  if (elevation < station.elevation.start_rad || elevation > station.elevation.stop_rad)
    return false;
  const double from_start = std::atan2(p.y(), p.x()) - station.azimuth.start_rad;
  const double turn = 2 * std::numbers::pi;
  const double past_start = from_start - turn * std::floor(from_start / turn);
  // A full turn stops one step short of its start.
  return past_start <=
         station.azimuth.stop_rad - station.azimuth.start_rad + station.azimuth.step_rad;
}

bool on_a_pip(const Die& die, const Eigen::Vector3d& x) {
  const double radius_m = pip_share * die.model.size_m.minCoeff();
  return std::any_of(die.facets.begin(), die.facets.end(), [&](const DieFacet& facet) {
    if (std::abs(facet.plane.signed_distance(x)) > 1e-6) return false;
    const Eigen::Vector2d uv(facet.u.dot(x - facet.centre_m), facet.v.dot(x - facet.centre_m));
    return std::any_of(facet.pip_centres_m.begin(), facet.pip_centres_m.end(),
                       [&](const Eigen::Vector2d& pip) { return (uv - pip).norm() < radius_m; });
  });
}

FisherStation planned_station(const std::shared_ptr<const Scene>& scene, std::size_t number,
                              const PlanAssumptions& assumptions) {
  const Station& station = scene->stations[number];
  FisherStation out;
  out.scene_from_scan = station.scene_from_scan;
  // Rays a solid angle: the two steps count as their product.
  out.step_rad = std::sqrt(station.azimuth.step_rad * station.elevation.step_rad);
  out.level_sd_rad = assumptions.level_sd_rad;
  out.noise = station.scanner.noise;
  out.sees = [scene, number, assumptions](const Eigen::Vector3d& x) {
    const Station& from = scene->stations[number];
    if (assumptions.within_windows && !in_window(from, x)) return false;
    if (assumptions.fitted_facets && assumptions.dice)
      for (const Die& die : scene->dice)
        if (on_a_pip(die, x)) return false;
    return !hidden(*scene, from.scene_from_scan.translation, x);
  };
  return out;
}

/// Widest beam that falls on a target, metres.
double footprint_m(const Scene& scene, const Eigen::Vector3d& centre_m) {
  double widest_m = 0;
  for (const Station& station : scene.stations)
    widest_m = std::max(widest_m, station.scanner.beam_diameter_m +
                                      station.scanner.beam_divergence_rad *
                                          (station.scene_from_scan.translation - centre_m).norm());
  return widest_m;
}

/// The facets of a die, cut back by the border that a fit leaves out.
FisherBody planned_die(const Scene& scene, const Die& die, const PlanAssumptions& assumptions) {
  const std::vector<Plane> planes(die.body.planes.begin(), die.body.planes.end());
  FisherBody body = assumptions.shape_known ? known_body(planes) : free_body(planes);
  if (!assumptions.fitted_facets) return body;
  const double border_m = std::max(
      {die.model.edge_radius_m, least_border_m, footprint_m(scene, bounding_ball(die).centre_m)});
  for (std::size_t f = 0; f < planes.size(); ++f) {
    std::vector<Plane> inset = planes;
    for (std::size_t k = 0; k < planes.size(); ++k)
      if (k != f) inset[k].offset_m -= border_m;
    body.facets[f] = facet_of_planes(inset, f);
  }
  return body;
}

bool same_edge(const FisherEdge& a, const FisherEdge& b) {
  return std::minmax(a.first, a.second) == std::minmax(b.first, b.second);
}

/// The edges that a user measures: each that a slave and the master share.
void add_edges(FisherBody& body, const std::vector<FisherStation>& stations, double sd_m) {
  for (std::size_t s = 1; s < stations.size(); ++s) {
    int both = 0, master = 0, slave = 0;
    for (const FisherFacet& facet : body.facets) {
      const bool in_master = faces(facet, stations[0]), in_slave = faces(facet, stations[s]);
      both += in_master && in_slave ? 1 : 0;
      master += in_master ? 1 : 0;
      slave += in_slave ? 1 : 0;
    }
    if (both != 2 || master != 3 || slave != 3) continue;
    FisherEdge edge = shared_edge(body, stations[0], stations[s]);
    edge.sd_m = sd_m;
    const bool known = std::any_of(body.edges.begin(), body.edges.end(),
                                   [&](const FisherEdge& e) { return same_edge(e, edge); });
    if (!known) body.edges.push_back(edge);
  }
}

FisherBody planned_patch(const Patch& patch, const Eigen::Vector3d& seen_from) {
  Plane plane = plane_of(patch);
  if (plane.signed_distance(seen_from) < 0) plane = plane.flipped();
  const Eigen::Vector3d far_u = patch.corner_m + patch.side_u_m;
  return calibration_plane(
      {plane, {patch.corner_m, far_u, far_u + patch.side_v_m, patch.corner_m + patch.side_v_m}});
}

}  // namespace

FisherScene planned_scene(const Scene& given, const PlanAssumptions& assumptions) {
  const auto scene = std::make_shared<const Scene>(given);
  FisherScene out;
  for (std::size_t s = 0; s < scene->stations.size(); ++s)
    out.stations.push_back(planned_station(scene, s, assumptions));
  if (out.stations.size() < 2)
    throw usage_error("plan: a registration needs two stations; add a [[station]] to the scene");
  if (assumptions.dice)
    for (const Die& die : scene->dice) {
      out.bodies.push_back(planned_die(*scene, die, assumptions));
      if (!assumptions.shape_known)
        add_edges(out.bodies.back(), out.stations, assumptions.edge_sd_m);
    }
  if (assumptions.planes)
    for (const Patch& patch : scene->patches)
      if (patch.role == PatchRole::calibration)
        out.bodies.push_back(planned_patch(patch, scene->stations[0].scene_from_scan.translation));
  if (assumptions.spheres)
    for (const Sphere& sphere : scene->spheres)
      out.spheres.push_back({sphere.centre_m, sphere.radius_m, true});
  if (out.bodies.empty() && out.spheres.empty())
    throw usage_error(
        "plan: no target; the scene needs a [[die]], a [[sphere]] or a patch with the role "
        "calibration");
  return out;
}

std::vector<PlannedFacet> planned_facets(const Scene& scene, const PlanAssumptions& assumptions) {
  std::vector<PlannedFacet> out;
  if (scene.dice.empty() || !assumptions.dice) return out;
  const FisherScene planned = planned_scene(scene, assumptions);
  // With a residual of unit deviation everywhere the information about the offset is the number of
  // rays.
  NoiseModel unit{0, 0, 1, 0, 0};
  for (std::size_t s = 0; s < planned.stations.size(); ++s) {
    for (std::size_t f = 0; f < planned.bodies[0].facets.size(); ++f) {
      const FisherFacet& facet = planned.bodies[0].facets[f];
      if (!faces(facet, planned.stations[s])) continue;
      const Eigen::Vector3d ray =
          (facet_centre(facet) - planned.stations[s].scene_from_scan.translation).normalized();
      out.push_back({s, static_cast<int>(f) + 1,
                     facet_information(facet, planned.stations[s], unit)(0, 0),
                     std::acos(std::min(1.0, -ray.dot(facet.plane.normal)))});
    }
  }
  return out;
}

}  // namespace alea
