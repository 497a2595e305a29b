#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/register_die.hpp"
#include "alea/plane/region_fit.hpp"
#include "experiments/benchmarks/plane_peers.hpp"

// Usage: benchmark_registration MASTER.ply SLAVE.ply EDGE_M [ROUNDS]
// Registers two scans from files to the transform with three plane detectors, in turn, and prints
// medians: everything but the detector is the same code.

namespace alea::benchmarks {
namespace {

struct Cost {
  double wall_s, cpu_s;
};

double cpu_now_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Contestant {
  std::string name;
  std::function<std::vector<PlaneRegion>(const Cloud&)> find_planes;  ///< empty: Alea's cells
  std::vector<Cost> costs;
  std::string outcome;
};

std::vector<PlaneRegion> regions_of(const Cloud& cloud, const PointSets& sets) {
  std::vector<PlaneRegion> out;
  for (std::vector<std::uint32_t> set : sets) {
    if (set.size() < 3) continue;
    std::sort(set.begin(), set.end());
    out.push_back(fit_region(cloud, std::move(set)));
  }
  return out;
}

PeerOptions peer_options() {
  PeerOptions options;
  options.min_points = 50;
  options.epsilon_m = 0.006;
  options.cluster_epsilon_m = 0.1;
  return options;
}

std::vector<PlaneRegion> by_cgal(const Cloud& cloud) {
  EfficientRansacPeer peer(cloud.positions);
  peer.prepare();
  return regions_of(cloud, peer.detect(peer_options()));
}

std::vector<PlaneRegion> by_pcl(const Cloud& cloud) {
  return regions_of(cloud, PclPlanesPeer(cloud.positions).detect(peer_options()));
}

void run(Contestant& contestant, const std::vector<std::string>& files, double edge_m) {
  DieRegistrationOptions options;
  options.edge_m = edge_m;
  options.find_planes = contestant.find_planes;
  const double cpu = cpu_now_s();
  const auto start = std::chrono::steady_clock::now();
  std::vector<Cloud> clouds(2);
  parallel_chunks(2, 1, [&](std::size_t i, std::size_t) { clouds[i] = read_cloud(files[i]); });
  const Registration result = register_die(clouds[0], clouds[1], options);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  contestant.costs.push_back({wall.count(), cpu_now_s() - cpu});
  contestant.outcome = result.master_from_slave ? "registered" : to_string(result.refusal->code);
}

double median(const std::vector<Cost>& costs, double Cost::*member) {
  std::vector<double> values;
  for (const Cost& cost : costs) values.push_back(cost.*member);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

int compare(const std::vector<std::string>& files, double edge_m, int rounds) {
  std::vector<Contestant> contestants{{"cells (Alea)", {}, {}, {}},
                                      {"CGAL normals + Efficient RANSAC", by_cgal, {}, {}},
                                      {"PCL SACSegmentation, iterated", by_pcl, {}, {}}};
  for (int round = 0; round <= rounds; ++round)
    for (Contestant& contestant : contestants) {
      run(contestant, files, edge_m);
      if (round == 0) contestant.costs.clear();  // warms up files and threads
    }
  const Contestant& own = contestants.front();
  for (const Contestant& c : contestants)
    fmt::print("{:<34} wall {:8.1f} ms  CPU {:8.1f} ms  {:6.1f} x wall {:6.1f} x CPU  {} (n={})\n",
               c.name, 1e3 * median(c.costs, &Cost::wall_s), 1e3 * median(c.costs, &Cost::cpu_s),
               median(c.costs, &Cost::wall_s) / median(own.costs, &Cost::wall_s),
               median(c.costs, &Cost::cpu_s) / median(own.costs, &Cost::cpu_s), c.outcome, rounds);
  return own.outcome == "registered" ? 0 : 1;
}

}  // namespace
}  // namespace alea::benchmarks

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: benchmark_registration MASTER SLAVE EDGE_M [ROUNDS]\n");
    return 2;
  }
  return alea::benchmarks::compare({argv[1], argv[2]}, std::stod(argv[3]),
                                   argc > 4 ? std::stoi(argv[4]) : 5);
}
