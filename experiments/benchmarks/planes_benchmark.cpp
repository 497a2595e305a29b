#include <benchmark/benchmark.h>

#include <fstream>
#include <map>
#include <string>

#include "alea/core/parallel.hpp"
#include "alea/plane/plane_detector.hpp"
#include "experiments/benchmarks/plane_peers.hpp"
#include "experiments/benchmarks/room_scene.hpp"

namespace alea::benchmarks {
namespace {

// 100 points of 100,000, 500 of a million, 2,500 of ten million.
std::size_t least_points(std::int64_t points) {
  return points <= 200000 ? 100 : points <= 2000000 ? 500 : 2500;
}

PeerOptions peer_options(std::int64_t points) {
  PeerOptions options;
  options.min_points = least_points(points);
  options.cluster_epsilon_m = points <= 200000 ? 0.25 : points <= 2000000 ? 0.1 : 0.05;
  return options;
}

// Peak of the process since the last call of reset_peak, bytes (Linux).
void reset_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

double status_bytes(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string word; in >> word;) {
    double kilobytes = 0;
    if (word == key && in >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

void report(benchmark::State& state, const PointSets& sets,
            const std::vector<Eigen::Vector3d>& normals = {}) {
  const Room& scene = room(static_cast<std::size_t>(state.range(0)));
  const Recovery r = recovery(scene, sets, least_points(state.range(0)), normals);
  state.counters["points"] = static_cast<double>(scene.scan.cloud.size());
  state.counters["planes"] = static_cast<double>(r.planes);
  state.counters["found"] = static_cast<double>(r.found);
  state.counters["sets"] = static_cast<double>(sets.size());
  state.counters["worst_deg"] = r.worst_deg;
  state.counters["ideal_deg"] = r.worst_ideal_deg;
  state.counters["determined_deg"] = r.worst_determined_deg;
}

void run_detector(benchmark::State& state, PlaneDetector detector, int threads) {
  const ThreadLimit limit(threads);
  const Cloud& cloud = room(static_cast<std::size_t>(state.range(0))).scan.cloud;
  PlaneDetectionOptions options;
  options.detector = detector;
  options.min_points = least_points(state.range(0));
  std::vector<PlaneRegion> regions;
  double peak = 0;
  for (auto _ : state) {
    state.PauseTiming();
    regions.clear();
    regions.shrink_to_fit();
    reset_peak();
    const double before = status_bytes("VmRSS:");
    state.ResumeTiming();
    regions = detect_planes(cloud, options);
    state.PauseTiming();
    peak = std::max(peak, status_bytes("VmHWM:") - before);
    state.ResumeTiming();
  }
  PointSets sets;
  std::vector<Eigen::Vector3d> normals;
  for (PlaneRegion& region : regions) {
    sets.push_back(std::move(region.indices));
    normals.push_back(region.plane.normal);
  }
  report(state, sets, normals);
  state.counters["bytes_per_point"] = peak / static_cast<double>(cloud.size());
}

void cells(benchmark::State& state) {
  run_detector(state, PlaneDetector::cells, 1);
}
void cells_two_threads(benchmark::State& state) {
  run_detector(state, PlaneDetector::cells, 2);
}
void ndt_ransac(benchmark::State& state) {
  run_detector(state, PlaneDetector::ndt_ransac, 1);
}

// The three facets of a 0.5 m die at 6 m, alone in the cloud.
void cells_die(benchmark::State& state) {
  const ThreadLimit limit(1);
  const Cloud cloud = testing::cube_scan(0.5, 6, 0.8, 0.00033).cloud;
  std::size_t planes = 0;
  for (auto _ : state) planes = detect_planes(cloud).size();
  state.counters["points"] = static_cast<double>(cloud.size());
  state.counters["found"] = static_cast<double>(planes);
}

void cgal_efficient_ransac(benchmark::State& state) {
  static std::map<std::int64_t, EfficientRansacPeer> peers;
  const Cloud& cloud = room(static_cast<std::size_t>(state.range(0))).scan.cloud;
  EfficientRansacPeer& peer = peers.try_emplace(state.range(0), cloud.positions).first->second;
  PointSets sets;
  for (auto _ : state) {
    state.PauseTiming();
    peer.prepare();
    state.ResumeTiming();
    sets = peer.detect(peer_options(state.range(0)));
  }
  report(state, sets);
}

void pcl_iterated(benchmark::State& state) {
  const PclPlanesPeer peer(room(static_cast<std::size_t>(state.range(0))).scan.cloud.positions);
  PointSets sets;
  for (auto _ : state) sets = peer.detect(peer_options(state.range(0)));
  report(state, sets);
}

BENCHMARK(cells)->Arg(100000)->Arg(1000000)->Arg(10000000)->Iterations(1)->Unit(
    benchmark::kMillisecond);
BENCHMARK(cells_die)->Unit(benchmark::kMillisecond);
BENCHMARK(cells_two_threads)
    ->Arg(100000)
    ->Arg(1000000)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(ndt_ransac)->Arg(100000)->Arg(1000000)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(cgal_efficient_ransac)
    ->Arg(100000)
    ->Arg(1000000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(pcl_iterated)->Arg(100000)->Arg(1000000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace alea::benchmarks

BENCHMARK_MAIN();
