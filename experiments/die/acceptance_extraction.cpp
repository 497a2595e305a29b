#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/die_finder.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/acceptance.hpp"

namespace alea::acceptance {
namespace {

constexpr double extraction_edge_m = 0.5, extraction_range_m = 6, scanner_height_m = 1.6;

/// How facets are taken out of the scans, and what die is scanned.
struct Extraction {
  std::string name;
  double edge_radius_m = 0;
  double step_rad = 5e-4;
  FacetFitOptions facets;
};

Extraction ray_extraction(const std::string& name, double radius_m, double trim_m) {
  Extraction out{name, radius_m, 5e-4, {}};
  out.facets.fit.scanner_position = Eigen::Vector3d::Zero();
  if (trim_m >= 0) out.facets.trim_m = trim_m;
  return out;
}

Extraction naive_extraction() {
  Extraction out = ray_extraction("sharp, PCA, 10 mm band, no nearest plane, no trim", 0, 0);
  out.facets.fit.method = FitMethod::orthogonal;
  out.facets.nearest_plane = false;
  out.facets.gate_m = 0.01;
  out.facets.trim_m = -0.01;  // the band reaches over the borders too
  return out;
}

Scene die_on_floor(double edge_radius_m) {
  DieModel model;
  model.size_m.setConstant(extraction_edge_m);
  model.edge_radius_m = edge_radius_m;
  model.scene_from_die.translation = {0, 0, extraction_edge_m / 2};
  Scene scene;
  scene.dice.push_back(build_die(model));
  Patch floor;
  floor.corner_m = {-2, -2, 0};
  floor.side_u_m = {4, 0, 0}, floor.side_v_m = {0, 4, 0};
  scene.patches.push_back(floor);
  return scene;
}

/// A scan with the facets found in it; pips are told by the true planes.
struct Observation {
  RigidTransform scene_from_scan;
  ObservedDie die;
};

std::optional<Observation> observe(const Extraction& extraction, const Scene& scene,
                                   std::uint64_t seed, std::uint64_t trial, std::uint32_t scan) {
  const RandomStream random({seed, 5, trial, scan, Purpose::station});
  const double distance = std::sqrt(extraction_range_m * extraction_range_m -
                                    std::pow(scanner_height_m - extraction_edge_m / 2, 2));
  const double azimuth = std::numbers::pi / 4 + scan * std::numbers::pi / 2;
  Observation out;
  out.scene_from_scan =
      levelled_pose({distance * std::cos(azimuth), distance * std::sin(azimuth), scanner_height_m},
                    2 * std::numbers::pi * random.uniform_at(0));
  const auto phase = random.uniform2_at(1);
  const Station station = aimed_station(out.scene_from_scan, bounding_ball(scene.dice[0]),
                                        extraction.step_rad, Eigen::Vector2d(phase[0], phase[1]));
  const Cloud cloud = simulate_scan(scene, station, {seed, 5, trial, scan});
  DieFinderOptions options;
  options.edge_m = extraction_edge_m;
  options.facets = extraction.facets;
  const auto dice = find_dice(cloud, detect_planes(cloud), options);
  if (!dice) return std::nullopt;
  const DieCandidate& found = dice->front();
  for (std::size_t k = 0; k < 3; ++k) {
    ObservedFacet& facet = out.die.facets[k];
    facet.fit = found.facets.fits[k];
    const Eigen::Vector3d normal = out.scene_from_scan.rotation * facet.fit.plane.normal;
    for (int pips = 1; pips <= 6; ++pips)
      if (scene.dice[0].facets[static_cast<std::size_t>(pips) - 1].plane.normal.dot(normal) > 0.9)
        facet.pips = pips;
  }
  std::sort(out.die.facets.begin(), out.die.facets.end(),
            [](const ObservedFacet& a, const ObservedFacet& b) { return a.pips < b.pips; });
  return out;
}

struct Run {
  bool registered = false;
  double rotation_rad = 0;
};

Run run_once(const Extraction& extraction, const Scene& scene, std::uint64_t seed,
             std::uint64_t trial) {
  const auto master = observe(extraction, scene, seed, trial, 0);
  const auto slave = observe(extraction, scene, seed, trial, 1);
  if (!master || !slave) return {};
  ClosedFormOptions options;
  options.edge_m = extraction_edge_m;
  const auto result = register_closed_form(master->die, slave->die, options);
  if (!result) return {};
  const Eigen::Matrix3d scene_from_slave =
      master->scene_from_scan.rotation * result->master_from_slave.rotation;
  return {true, rotation_angle_rad(scene_from_slave.transpose() * slave->scene_from_scan.rotation)};
}

double rms(const std::vector<Run>& runs, const RandomStream* resample, std::uint64_t from) {
  double sum = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t pick =
        resample == nullptr
            ? i
            : static_cast<std::size_t>(resample->uniform_at(from + i) * runs.size());
    sum += std::pow(runs[std::min(pick, runs.size() - 1)].rotation_rad, 2);
  }
  return std::sqrt(sum / static_cast<double>(runs.size()));
}

/// 95 % bootstrap interval of the RMS rotation.
Interval bootstrap(const std::vector<Run>& runs, std::uint64_t seed) {
  constexpr std::size_t resamples = 1000;
  const RandomStream random({seed, 5, 0, 0, Purpose::bootstrap});
  std::vector<double> values;
  for (std::size_t b = 0; b < resamples; ++b) values.push_back(rms(runs, &random, b * runs.size()));
  std::sort(values.begin(), values.end());
  return {values[25], values[974]};
}

std::vector<Run> run_all(const Extraction& extraction, std::uint64_t trials, std::uint64_t seed) {
  const Scene scene = die_on_floor(extraction.edge_radius_m);
  std::vector<Run> runs(trials);
  parallel_chunks(trials, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) runs[i] = run_once(extraction, scene, seed, i);
  });
  return runs;
}

/// Drops refused runs and reports how many there were.
std::vector<Run> registered_only(std::vector<Run> runs, const Extraction& extraction,
                                 const Report& report) {
  const auto all = runs.size();
  std::erase_if(runs, [](const Run& run) { return !run.registered; });
  const auto refused = static_cast<double>(all - runs.size());
  report({extraction.name + ": refused",
          refused,
          {refused, refused},
          at_most(0),
          all,
          "",
          Judgement::point});
  return runs;
}

double bound_rad(double step_rad) {
  DieBoundCase geometry;
  geometry.edge_m = extraction_edge_m, geometry.range_m = extraction_range_m,
  geometry.step_rad = step_rad;
  geometry.scanner_height_m = scanner_height_m;
  geometry.shape_known = false;
  return die_bound(geometry).rotation_rad;
}

void report_ratio(const Extraction& extraction, const Limit& limit, Judgement judgement,
                  const Options& options, const Report& report) {
  const auto runs = registered_only(run_all(extraction, options.trials_or(100), options.seed),
                                    extraction, report);
  if (runs.empty()) return;
  const double bound = bound_rad(extraction.step_rad);
  const Interval interval = bootstrap(runs, options.seed);
  report({extraction.name + ": rotation / L",
          rms(runs, nullptr, 0) / bound,
          {interval.low / bound, interval.high / bound},
          limit,
          runs.size(),
          "",
          judgement});
}

void report_rotation(const Extraction& extraction, const Limit& limit, const Options& options,
                     const Report& report) {
  const auto runs = registered_only(run_all(extraction, options.trials_or(100), options.seed),
                                    extraction, report);
  if (runs.empty()) return;
  const Interval interval = bootstrap(runs, options.seed);
  report({extraction.name + ": rotation",
          rms(runs, nullptr, 0) / deg,
          {interval.low / deg, interval.high / deg},
          limit,
          runs.size(),
          "deg",
          Judgement::point});
}

}  // namespace

void run_extraction(const Options& options, const Report& report) {
  for (const double radius : {0.01, 0.02, 0.03}) {
    const std::string name = fmt::format("radius {:.0f} mm", 1e3 * radius);
    report_ratio(ray_extraction(name + ", trim = radius", radius, radius), at_most(1.6),
                 Judgement::point, options, report);
    report_ratio(ray_extraction(name + ", radius and trim estimated", radius, -1), at_most(1.6),
                 Judgement::point, options, report);
    if (radius > 0.015)
      report_ratio(ray_extraction(name + ", no trim", radius, 0), at_least(3), Judgement::point,
                   options, report);
  }
  report_ratio(ray_extraction("sharp, trim estimated", 0, -1), {}, Judgement::shown, options,
               report);
  report_rotation(naive_extraction(), at_least(0.3), options, report);
}

}  // namespace alea::acceptance
