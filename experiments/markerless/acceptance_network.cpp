#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <set>

#include "alea/core/seed.hpp"
#include "alea/markerless/pose_graph.hpp"
#include "experiments/markerless/acceptance.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::acceptance {
namespace {

using namespace experiments::markerless;

using std::numbers::pi;
// Of a robust pose on the twins, 1 sigma: the median errors when it is right.
constexpr double rotation_sd_rad = 0.01 * pi / 180, translation_sd_m = 0.003;

struct NetworkDraw {
  std::vector<PoseEdge> edges;
  std::set<std::size_t> wrong;
};

/// Every true pair perturbed by its covariance, a fifth of the pairs turned about the tower's axis.
NetworkDraw draw_network(const Scene& scene,
                         const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                         double wrong_share, RandomStream& stream) {
  NetworkDraw draw;
  for (const auto& [a, b] : pairs) {
    PoseEdge edge;
    edge.a = a;
    edge.b = b;
    RigidTransform turn;
    if (stream.uniform() < wrong_share) {
      draw.wrong.insert(draw.edges.size());
      const double angle = pi / 3 * static_cast<double>(1 + stream.below(3));
      turn.rotation = rotation_exp({0, 0, angle});
    }
    edge.a_from_b =
        scene.stations[a].scene_from_scan.inverse() * turn * scene.stations[b].scene_from_scan;
    Vector6d sd, off;
    sd << Eigen::Vector3d::Constant(rotation_sd_rad), Eigen::Vector3d::Constant(translation_sd_m);
    for (int k = 0; k < 6; ++k) off[k] = sd[k] * stream.normal();
    edge.covariance = sd.cwiseAbs2().asDiagonal();
    edge.a_from_b = perturb_left(edge.a_from_b, off, Eigen::Vector3d::Zero());
    draw.edges.push_back(edge);
  }
  return draw;
}

struct Largest {
  double rotation_deg = 0, translation_m = 0;
};

Largest largest_error(const Scene& scene, const PoseGraph& graph) {
  Largest largest;
  for (std::size_t s = 0; s < scene.stations.size(); ++s) {
    const RigidTransform truth =
        scene.stations[0].scene_from_scan.inverse() * scene.stations[s].scene_from_scan;
    const PoseError error = pose_error(graph.network_from_scan[s], truth);
    largest.rotation_deg = std::max(largest.rotation_deg, error.rotation_deg);
    largest.translation_m = std::max(largest.translation_m, error.translation_m);
  }
  return largest;
}

/// Stations on a ring of 500 m; each sees the next three, and every tenth one across.
Scene long_network(std::size_t stations) {
  Scene scene;
  for (std::size_t s = 0; s < stations; ++s) {
    const double angle = 2 * pi * static_cast<double>(s) / static_cast<double>(stations);
    Station station;
    station.scene_from_scan = levelled_pose(
        {500 * std::cos(angle), 500 * std::sin(angle), std::sin(7 * angle)}, 3 * angle);
    scene.stations.push_back(station);
  }
  return scene;
}

void report_long_network(const Options& options, const Report& report) {
  const std::size_t n = 1000;
  const Scene scene = long_network(n);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t s = 0; s < n; ++s)
    for (const std::size_t step : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
      pairs.emplace_back(s, (s + step) % n);
  for (std::size_t s = 0; s < n; s += 10) pairs.emplace_back(s, (s + n / 2) % n);
  RandomStream stream({options.seed, 6, 1000, 0, Purpose::experiment});
  const NetworkDraw draw = draw_network(scene, pairs, 0.02, stream);
  // CPU time of all threads: other processes do not lengthen it, and the wall's is no more.
  const std::clock_t start = std::clock();
  const auto graph = solve_pose_graph(n, draw.edges);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  report(
      point_cell("1000 stations with loops: solved", graph ? 1 : 0, "", at_least(1), pairs.size()));
  report(point_cell("1000 stations with loops: CPU time", seconds, "s", at_most(10), pairs.size()));
}

}  // namespace

void run_markerless_network(const Options& options, const Report& report) {
  const std::uint64_t draws = options.trials_or(50);
  std::uint64_t within = 0, named = 0;
  Largest largest;
  for (std::uint64_t d = 0; d < draws; ++d) {
    TwinOptions twin;
    twin.layout = options.seed + d;
    const Scene scene = bell_tower(twin);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < scene.stations.size(); ++a)
      for (std::size_t b = a + 1; b < scene.stations.size(); ++b) pairs.emplace_back(a, b);
    RandomStream stream({options.seed, 6, d, 0, Purpose::experiment});
    const NetworkDraw draw = draw_network(scene, pairs, 0.2, stream);
    const auto graph = solve_pose_graph(scene.stations.size(), draw.edges);
    if (!graph) continue;
    const Largest error = largest_error(scene, *graph);
    largest.rotation_deg = std::max(largest.rotation_deg, error.rotation_deg);
    largest.translation_m = std::max(largest.translation_m, error.translation_m);
    within += error.rotation_deg < 0.05 && error.translation_m < 0.01 ? 1 : 0;
    named += std::equal(draw.wrong.begin(), draw.wrong.end(), graph->rejected.begin(),
                        graph->rejected.end())
                 ? 1
                 : 0;
  }
  const auto all = static_cast<double>(draws);
  report(point_cell("draws with every station within 0.05 deg and 0.01 m",
                    static_cast<double>(within), "", at_least(all), draws));
  report(point_cell("draws with exactly the wrong edges named", static_cast<double>(named), "",
                    at_least(all), draws));
  report({"largest rotation error of a station",
          largest.rotation_deg,
          {largest.rotation_deg, largest.rotation_deg},
          {},
          draws,
          "deg",
          Judgement::shown});
  report({"largest translation error of a station",
          largest.translation_m,
          {largest.translation_m, largest.translation_m},
          {},
          draws,
          "m",
          Judgement::shown});
  report_long_network(options, report);
}

}  // namespace alea::acceptance
