// markerless_peers make FILE [STEP_RAD]: two outdoor scans of the bell tower, their pose and a
// start 1 deg and 0.15 m off it. markerless_peers run FILE: one round of grid average, normals,
// neighbour queries and point-to-plane ICP by Alea, PCL, CGAL and nanoflann, and of a robust pair.
// markerless_open3d.py runs rounds of it in turn with Open3D's and prints the medians.

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "alea/cloud/neighbours.hpp"
#include "alea/cloud/normals.hpp"
#include "alea/cloud/sampling.hpp"
#include "alea/core/angle.hpp"
#include "alea/pipeline/register_markerless.hpp"
#include "experiments/benchmarks/point_peers.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace {

using namespace alea;                           // NOLINT: a program of one page
using namespace alea::experiments::markerless;  // NOLINT
using namespace alea::benchmarks;               // NOLINT

struct Pair {
  Cloud fixed, moving;
  RigidTransform truth, start;
};

void write(std::ofstream& out, const void* values, std::size_t doubles) {
  out.write(static_cast<const char*>(values), static_cast<std::streamsize>(8 * doubles));
}

int make(const std::string& file, double step_rad) {
  TwinOptions options;
  options.step_rad = step_rad;
  const TwinScans scans = scan_twin(bell_tower(options), {0, 1}, 1);
  std::ofstream out(file, std::ios::binary);
  for (const Cloud& cloud : scans.clouds) {
    const double count = static_cast<double>(cloud.size());
    write(out, &count, 1);
    for (const Eigen::Vector3d& p : cloud.positions) write(out, p.data(), 3);
  }
  RigidTransform start = scans.truth(0, 1);
  start.rotation = Eigen::AngleAxisd(1 * deg, Eigen::Vector3d::UnitZ()) * start.rotation;
  start.translation += Eigen::Vector3d(0.1, 0.1, 0.05);
  for (const RigidTransform& pose : {scans.truth(0, 1), start}) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = pose.matrix();
    write(out, matrix.data(), 16);
  }
  return out.good() ? 0 : 3;
}

Pair read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const auto fill = [&](double* values, std::size_t count) {
    in.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(8 * count));
  };
  Pair pair;
  for (Cloud* cloud : {&pair.fixed, &pair.moving}) {
    double count = 0;
    fill(&count, 1);
    cloud->positions.resize(static_cast<std::size_t>(count));
    for (Eigen::Vector3d& p : cloud->positions) fill(p.data(), 3);
    cloud->scanner_position = Eigen::Vector3d::Zero();
  }
  for (RigidTransform* pose : {&pair.truth, &pair.start}) {
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
    fill(matrix.data(), 16);
    pose->rotation = matrix.topLeftCorner<3, 3>();
    pose->translation = matrix.topRightCorner<3, 1>();
  }
  return pair;
}

/// Prints task, program, wall seconds and what `work` returns about its result.
void timed(const std::string& task, const std::string& program,
           const std::function<std::string()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::string result = work();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  fmt::print("{} {} {:.4f} {}\n", task, program, wall.count(), result);
  std::fflush(stdout);
}

std::string error_of(const RigidTransform& pose, const RigidTransform& truth) {
  const PoseError error = pose_error(pose, truth);
  return fmt::format("{:.4f}_deg_{:.5f}_m", error.rotation_deg, error.translation_m);
}

void run_neighbours(const Cloud& cloud) {
  // Built before the clock: what counts is a query. Every tenth point, 16 neighbours.
  const NeighbourIndex index(cloud.positions);
  const NanoflannPeer peer(cloud.positions);
  timed("neighbours", "alea", [&] {
    double sum = 0;
    std::vector<Neighbour> found(16);
    for (std::size_t i = 0; i < cloud.size(); i += 10) {
      index.nearest(cloud.positions[i], std::span<Neighbour>(found));
      sum += found.back().squared_distance_m2;
    }
    return fmt::format("{:.6f}", sum);
  });
  timed("neighbours", "nanoflann", [&] {
    double sum = 0;
    for (std::size_t i = 0; i < cloud.size(); i += 10)
      sum += peer.squared_distance_of(cloud.positions[i], 16);
    return fmt::format("{:.6f}", sum);
  });
}

void run_icp(const Pair& pair) {
  Cloud fixed = pair.fixed;
  for (const Eigen::Vector3d& n : estimate_normals(fixed, {16, {}}))
    fixed.normals.push_back(n.cast<float>());
  timed("icp", "alea", [&] {
    IcpOptions options;
    options.max_distance_m = 0.3;
    options.max_iterations = 30;
    return error_of(icp(fixed, pair.moving, pair.start, options).target_from_source, pair.truth);
  });
  PclIcpPeer peer(fixed, pair.moving);
  timed("icp", "pcl", [&] { return error_of(peer.align(pair.start, 0.3, 30), pair.truth); });
}

int run(const std::string& file) {
  const Pair pair = read(file);
  timed("grid", "alea", [&] { return fmt::format("{}", grid_average(pair.fixed, 0.05).size()); });
  const PclGridPeer grid(pair.fixed.positions);
  timed("grid", "pcl", [&] { return fmt::format("{}", grid.size_of(0.05)); });
  timed("normals", "alea", [&] {
    return fmt::format("{}", estimate_normals(pair.fixed, {16, {}}).size());
  });
  timed("normals", "cgal",
        [&] { return fmt::format("{}", cgal_normals(pair.fixed.positions, 16)); });
  run_neighbours(pair.fixed);
  run_icp(pair);
  timed("robust_pair", "alea", [&] {
    const auto found = register_markerless(pair.fixed, pair.moving, {});
    return found.registration.master_from_slave
               ? error_of(*found.registration.master_from_slave, pair.truth)
               : std::string("refused");
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::strcmp(argv[1], "make") == 0)
    return make(argv[2], argc > 3 ? std::stod(argv[3]) : 2.8e-3);
  if (argc > 2 && std::strcmp(argv[1], "run") == 0) return run(argv[2]);
  fmt::print(stderr, "usage: markerless_peers make|run FILE [STEP_RAD]\n");
  return 2;
}
