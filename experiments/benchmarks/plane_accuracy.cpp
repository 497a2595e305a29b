// plane_accuracy [SEEDS] [POINTS]: the planes of 1,000 points or more of the furnished room as
// `cells` finds them, over several seeds: errors of the normals beside what the points allow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "alea/plane/plane_detector.hpp"
#include "experiments/benchmarks/room_scene.hpp"

namespace alea::benchmarks {
namespace {

/// One plane over all seeds.
struct Row {
  std::size_t points = 0;
  int seeds = 0, within = 0;
  double own_sd_deg = 0, squares = 0, ideal_squares = 0, worst_deg = 0;
};

void add(const PlaneError& error, Row& row) {
  constexpr double wanted_deg = 0.02;
  row.points = error.points;
  row.own_sd_deg = error.own_sd_deg;
  row.squares += error.fit_deg * error.fit_deg;
  row.ideal_squares += error.ideal_deg * error.ideal_deg;
  row.worst_deg = std::max(row.worst_deg, error.fit_deg);
  row.within += error.fit_deg <= wanted_deg ? 1 : 0;
  ++row.seeds;
}

void run(int seeds, std::size_t points) {
  PlaneDetectionOptions options;
  options.min_points = 500;
  std::map<std::size_t, Row> rows;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Room scene = make_room(points, static_cast<std::uint64_t>(seed));
    std::vector<std::vector<std::uint32_t>> sets;
    std::vector<Eigen::Vector3d> normals;
    for (PlaneRegion& region : detect_planes(scene.scan.cloud, options)) {
      sets.push_back(std::move(region.indices));
      normals.push_back(region.plane.normal);
    }
    for (const PlaneError& error : recovery(scene, sets, 500, normals).errors)
      add(error, rows[error.plane]);
  }
  fmt::print("plane   points  own sd  cells rms  worst   true points rms  within 0.02 deg\n");
  for (const auto& [plane, row] : rows)
    fmt::print("{:5} {:8} {:7.4f} {:10.4f} {:6.4f} {:17.4f} {:8}/{}\n", plane, row.points,
               row.own_sd_deg, std::sqrt(row.squares / row.seeds), row.worst_deg,
               std::sqrt(row.ideal_squares / row.seeds), row.within, row.seeds);
}

}  // namespace
}  // namespace alea::benchmarks

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 10;
  const auto points = argc > 2 ? static_cast<std::size_t>(std::atof(argv[2])) : 1000000;
  alea::benchmarks::run(std::max(1, seeds), points);
}
