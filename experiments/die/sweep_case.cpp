#include "experiments/die/sweep_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/simulate/scene.hpp"
#include "experiments/die/sweep_die.hpp"

namespace alea::experiments::die {
namespace {

constexpr double scanner_height_m = 1.6;

TiltKind tilt_kind_of(const std::string& word) {
  if (word == "parallelepiped") return TiltKind::parallelepiped;
  return word == "single_facet" ? TiltKind::single_facet : TiltKind::random;
}

Extraction extraction_of(const SweepSettings& settings) {
  Extraction out;
  const std::string& how = word_of(settings, "extraction");
  out.direct = how == "direct";
  if (!out.direct) out.detector = plane_detector_from_name(how);
  out.domain =
      word_of(settings, "domain") == "ray" ? SelectionDomain::ray : SelectionDomain::coordinate;
  out.fit = word_of(settings, "fit") == "along_ray" ? FitMethod::along_ray : FitMethod::orthogonal;
  out.area_weights = word_of(settings, "weights") == "area";
  out.trim_m = number_of(settings, "trim_mm") * 1e-3;
  return out;
}

/// The default causes of noise in proportion to the range noise.
NoiseModel scaled_noise(double range_noise_m) {
  NoiseModel noise;
  const double share = range_noise_m / noise.range_noise_m;
  noise.range_noise_m *= share;
  noise.grazing_m *= share;
  noise.surface_m *= share;
  noise.angular_noise_rad *= share;
  return noise;
}

RigidTransform station_pose(const DieCase& setting, double azimuth_rad) {
  const double above_m = scanner_height_m - setting.edge_m / 2;
  const double least_m = std::max(std::abs(above_m), setting.edge_m * std::sqrt(0.75));
  if (setting.range_m <= least_m)
    throw usage_error(
        fmt::format("range_m = {:g} with edge_m = {:g}: the scanner, {:g} m up, would stand over "
                    "or in the die; "
                    "give more than {:.3g}",
                    setting.range_m, setting.edge_m, scanner_height_m, least_m));
  const double distance_m = std::sqrt(setting.range_m * setting.range_m - above_m * above_m);
  return station_at(distance_m, azimuth_rad, scanner_height_m, setting.step_rad).scene_from_scan;
}

FisherScene bound_scene(const DieCase& setting, bool shape_known) {
  FisherScene scene;
  scene.noise = setting.noise;
  for (const RigidTransform& pose : setting.scene_from_scan)
    scene.stations.push_back({pose, setting.step_rad, unknown_sd});
  const std::vector<Plane> planes = cube_on_floor(setting.edge_m);
  scene.bodies = {shape_known ? known_body(planes) : free_body(planes)};
  int shared = 0;
  for (const FisherFacet& facet : scene.bodies[0].facets)
    if (faces(facet, scene.stations[0]) && faces(facet, scene.stations[1])) ++shared;
  if (!shape_known && shared == 2)
    scene.bodies[0].edges = {shared_edge(scene.bodies[0], scene.stations[0], scene.stations[1])};
  return scene;
}

}  // namespace

std::vector<SweepParameter> die_parameters() {
  return {
      {"edge_m", 0.5, 0.02, 10, {}, "edge of the die (m)"},
      {"range_m", 6.0, 1.5, 200, {}, "scanner to the die's centre, both stations (m)"},
      {"step_mrad", 1.0, 0.02, 20, {}, "angular step, azimuth and elevation (mrad)"},
      {"separation_deg", 90.0, 0, 180, {}, "between the stations, as seen from the die (deg)"},
      {"range_noise_mm",
       1.3,
       0.001,
       100,
       {},
       "standard deviation along the ray (mm); the other causes of noise in proportion"},
      {"tilt_deg", 0.4, 0, 15, {}, "standard deviation of the facets' tilts, two directions (deg)"},
      {"tilt_kind",
       std::string("random"),
       0,
       0,
       {"random", "parallelepiped", "single_facet"},
       "which facets are tilted: all six, all with opposite ones parallel, the upper one"},
      {"edge_radius_mm", 0.0, 0, 200, {}, "radius of the die's edges (mm)"},
      {"bow_mm", 0.0, -50, 50, {}, "outward bow of every facet at its centre (mm)"},
      {"length",
       std::string("true"),
       0,
       0,
       {"true", "nominal"},
       "length given for the shared edge: its own or that of the cube"},
      {"tilt_prior_deg", 0.0, 0, 15, {}, "tilt prior for pairs that share one facet; 0: none"},
      {"extraction",
       std::string("direct"),
       0,
       0,
       {"direct", "cells", "efficient_ransac", "region_growing", "ndt_ransac"},
       "facets sorted by the known die, or found by a plane detector on a floor"},
      {"domain",
       std::string("ray"),
       0,
       0,
       {"ray", "coordinate"},
       "what a point's facet is decided by: its ray or its measured coordinates"},
      {"fit", std::string("along_ray"), 0, 0, {"along_ray", "orthogonal"}, "what a fit minimises"},
      {"weights",
       std::string("noise"),
       0,
       0,
       {"noise", "area"},
       "of a fit along the ray: by the noise model or by the surface a ray stands for"},
      {"trim_mm", -1.0, -100, 200, {}, "border left out of a detected facet (mm); -1: estimated"},
  };
}

DieCase die_case_of(const SweepSettings& settings) {
  DieCase out;
  out.edge_m = number_of(settings, "edge_m");
  out.range_m = number_of(settings, "range_m");
  out.step_rad = number_of(settings, "step_mrad") * 1e-3;
  out.separation_rad = number_of(settings, "separation_deg") * deg;
  out.noise = scaled_noise(number_of(settings, "range_noise_mm") * 1e-3);
  out.tilt_rad = number_of(settings, "tilt_deg") * deg;
  out.tilt_kind = tilt_kind_of(word_of(settings, "tilt_kind"));
  out.edge_radius_m = number_of(settings, "edge_radius_mm") * 1e-3;
  out.bow_m = number_of(settings, "bow_mm") * 1e-3;
  out.true_length = word_of(settings, "length") == "true";
  out.tilt_prior_rad = number_of(settings, "tilt_prior_deg") * deg;
  out.extraction = extraction_of(settings);
  const double first = std::numbers::pi / 4;
  out.scene_from_scan = {station_pose(out, first), station_pose(out, first + out.separation_rad)};
  return out;
}

Die draw_die(const DieCase& setting, std::uint64_t seed, std::uint64_t trial) {
  DieModel model;
  model.size_m.setConstant(setting.edge_m);
  model.pips.painted = false;
  model.edge_radius_m = setting.edge_radius_m;
  for (FacetShape& facet : model.facets) facet.bow_m = setting.bow_m;
  model.scene_from_die.translation.z() = setting.edge_m / 2;
  model = with_random_shape(model, {setting.tilt_rad, 0, 0}, seed, sweep_experiment_number, trial);
  auto& facets = model.facets;
  for (std::size_t f = 1; f < 6; ++f) {
    if (setting.tilt_kind == TiltKind::single_facet)
      facets[f].tilt_u_rad = facets[f].tilt_v_rad = 0;
    if (setting.tilt_kind == TiltKind::parallelepiped && f >= 3) {
      facets[f].tilt_u_rad = -facets[5 - f].tilt_u_rad;
      facets[f].tilt_v_rad = -facets[5 - f].tilt_v_rad;
    }
  }
  return build_die(model);
}

const std::array<CheckPlace, 4>& check_places() {
  static const std::array<CheckPlace, 4> places{{
      {{-3.0, -1.0, 1.4}, Eigen::Vector3d::UnitX()},
      {{1.0, -4.0, 1.1}, Eigen::Vector3d::UnitY()},
      {{2.5, 2.5, 0.0}, Eigen::Vector3d::UnitZ()},
      {{-2.0, 2.0, 0.75}, Eigen::Vector3d::UnitZ()},
  }};
  return places;
}

SweepBound bound_from(const DieCase& setting, const TransformCovariance& covariance) {
  const PoseAccuracy accuracy = pose_accuracy(covariance);
  SweepBound bound{accuracy.rotation_rad, accuracy.translation_m, 0, accuracy.ring10_m};
  const RigidTransform master_from_scene = setting.scene_from_scan[0].inverse();
  for (const CheckPlace& place : check_places()) {
    const Eigen::Vector3d lever = master_from_scene * place.centroid_m - covariance.about_m;
    const Eigen::Vector3d normal = master_from_scene.rotation * place.normal;
    Vector6d row;
    row << lever.cross(normal), normal;
    bound.check_m += row.dot(covariance.covariance * row) / check_places().size();
  }
  bound.check_m = std::sqrt(bound.check_m);
  return bound;
}

SweepBound die_bound_of(const DieCase& setting, bool shape_known) {
  const FisherBound bound = fisher_bound(bound_scene(setting, shape_known));
  const auto covariance = relative_covariance(bound, 0, 1, {0, 0, setting.edge_m / 2});
  return covariance ? bound_from(setting, *covariance) : SweepBound{};
}

}  // namespace alea::experiments::die
