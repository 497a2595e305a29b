// coloured_icp_pairs OUT [PAIRS]: large pairs first, then PAIRS of each of 18 cells: pairs of the
// checkerboard study with what Alea's coloured ICP makes of them, for coloured_icp_open3d.py, which
// lets Open3D align the same points.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "alea/cloud/normals.hpp"
#include "alea/core/seed.hpp"
#include "alea/transform/icp.hpp"
#include "experiments/checkerboard/synthetic_trial.hpp"

namespace {

using namespace alea;                             // NOLINT: a program of one page
using namespace alea::experiments::checkerboard;  // NOLINT

void write(std::ofstream& out, const double* values, std::size_t count) {
  out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(8 * count));
}

void write(std::ofstream& out, const Cloud& cloud) {
  const double count = static_cast<double>(cloud.size());
  write(out, &count, 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double row[4] = {cloud.positions[i].x(), cloud.positions[i].y(), cloud.positions[i].z(),
                           cloud.intensity[i]};
    write(out, row, 4);
  }
}

void write(std::ofstream& out, const RigidTransform& transform) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = transform.matrix();
  write(out, matrix.data(), 16);
}

IcpOptions coloured(double lambda = 0.968) {
  IcpOptions options;
  options.objective = IcpObjective::coloured;
  options.max_distance_m = 1;
  options.lambda = lambda;
  return options;
}

/// One pair: header (shift, rotation in deg, target), board, target, truth, Alea's answer, seconds.
void write_pair(std::ofstream& out, const SyntheticCase& synthetic, std::uint64_t trial) {
  const SyntheticPair pair = make_pair(synthetic, 1, trial);
  const auto start = std::chrono::steady_clock::now();
  const IcpResult result = icp(pair.target, pair.board, {}, coloured());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double head[4] = {synthetic.shift,
                          std::round(synthetic.rotation_rad * 180 / std::numbers::pi),
                          static_cast<double>(synthetic.target), seconds};
  write(out, head, 4);
  write(out, pair.board);
  write(out, pair.target);
  write(out, pair.target_from_board);
  write(out, result.target_from_source);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: coloured_icp_pairs OUT [PAIRS]\n");
    return 2;
  }
  const std::uint64_t pairs = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 400;
  std::ofstream out(argv[1], std::ios::binary);
  // Pairs of 20,000 points each, for the time.
  SyntheticCase large;
  large.points_along_side = 141;
  large.shift = 0.3;
  large.rotation_rad = 10 * std::numbers::pi / 180;
  large.target = Target::independent;
  for (std::uint64_t trial = 0; trial < 3; ++trial) write_pair(out, large, trial);
  for (const Target target : {Target::identical, Target::independent})
    for (const int rotation : {0, 10, 30})
      for (const int shift : {60, 90, 120})  // below, both always succeed
        for (std::uint64_t trial = 0; trial < pairs; ++trial) {
          SyntheticCase synthetic;
          synthetic.shift = shift / 100.0;
          synthetic.rotation_rad = rotation * std::numbers::pi / 180;
          synthetic.target = target;
          write_pair(out, synthetic, trial);
        }
  return out.good() ? 0 : 3;
}
