#pragma once

#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

/// Points in cubic cells, sorted by cell; what lies around a place is found without a tree.
class CubeIndex {
 public:
  CubeIndex(const Cloud& cloud, double cube_m);

  struct Cube {
    std::uint32_t first = 0, last = 0;  ///< places in `order`
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double intensity = 0;  ///< mean
  };
  const std::vector<Cube>& cubes() const { return cubes_; }
  /// The cubes whose number differs by at most `reach` along each axis, ascending by key.
  std::vector<std::uint32_t> around(const Eigen::Vector3d& place, int reach) const;
  /// Positions in the cloud of the points in these cubes.
  std::vector<std::uint32_t> points_of(const std::vector<std::uint32_t>& cubes) const;

 private:
  friend class CubeSurroundings;
  /// Number of the cube along each axis.
  Eigen::Array3i cell_of(const Eigen::Vector3d& place) const;

  Eigen::Vector3d low_;
  double cube_m_;
  std::vector<std::uint32_t> order_;
  std::vector<Cube> cubes_;
  std::vector<std::uint64_t> keys_;  ///< of the cubes, ascending
};

/// What CubeIndex::around gives, for places that follow each other: each search begins where the
/// last one ended.
class CubeSurroundings {
 public:
  CubeSurroundings(const CubeIndex& index, int reach);
  const std::vector<std::uint32_t>& around(const Eigen::Vector3d& place);

 private:
  /// The first cube at or behind `key`, looked for from `from`.
  std::uint32_t first_from(std::uint32_t from, std::uint64_t key) const;

  const CubeIndex& index_;
  int reach_;
  std::vector<std::uint32_t> starts_, found_;
};

struct Saddle {
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  double strength = 0;  ///< share of the intensities' variation that the second harmonic explains
  double contrast = 0;
  /// Unit, on the surface: the intensities along it lie above or below those across it. From one
  /// corner of a board to the next it turns by a quarter.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
};

/// Places where the intensities within `radius_m` on the surface have a second harmonic of at least
/// this strength, strongest (times contrast) first.
std::vector<Saddle> find_saddles(const CubeIndex& index, double cube_m, double radius_m,
                                 double least_contrast, double least_strength);

}  // namespace alea
