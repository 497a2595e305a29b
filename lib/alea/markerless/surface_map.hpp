#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

/// Where a scan has surfaces and which way they face, in cubic cells: answers in a few nanoseconds
/// what a search tree answers in a microsecond, for tests of thousands of poses.
class SurfaceMap {
 public:
  SurfaceMap() = default;
  /// `cloud` with normals; a point fills the eight cells around it. Cells grow beyond `cell_m`
  /// where the cloud is so wide that there would be more than eight million.
  SurfaceMap(const Cloud& cloud, double cell_m);

  /// Is there a surface nearby (within half a cell for certain, 1.5 cells at most along each axis)
  /// that faces the same way (about 45 deg)?
  bool has(const Eigen::Vector3d& place_m, const Eigen::Vector3d& normal) const;

 private:
  Eigen::Vector3d least_m_ = Eigen::Vector3d::Zero();
  double cell_m_ = 1;
  std::array<std::int64_t, 3> cells_{0, 0, 0};
  std::vector<std::uint32_t> facing_;  ///< a bit for each of the 26 directions
};

}  // namespace alea
