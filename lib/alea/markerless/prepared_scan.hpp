#pragma once

#include <Eigen/Core>
#include <memory>

#include "alea/cloud/neighbours.hpp"
#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/markerless/range_image.hpp"
#include "alea/markerless/surface_map.hpp"

namespace alea {

struct PrepareOptions {
  double cell_m = 0;           ///< grid average that the pose is refined on; 0: from the data
  std::size_t points = 30000;  ///< about as many are left where cell_m is 0
  int normal_neighbours = 12;  ///< on that grid
  bool levelled = false;       ///< the scanner's z axis is vertical within 0.5 deg
};

/// A scan as the search uses it: about its scanner, thinned to two grids with normals that face the
/// scanner, and the free space around it.
struct PreparedScan {
  Eigen::Vector3d scanner_m = Eigen::Vector3d::Zero();  ///< in the scan's own frame
  double cell_m = 0.1;
  Cloud fine;    ///< about the scanner, cell_m
  Cloud coarse;  ///< about the scanner, 3 cell_m
  Cloud probe;   ///< about 1500 points of `coarse`, for tests of many poses
  RangeImage free_space;
  /// Turns the scan upright: the vertical as the ground shows it becomes z.
  Eigen::Matrix3d upright_from_scan = Eigen::Matrix3d::Identity();
  NeighbourIndex fine_index;
  SurfaceMap surfaces;  ///< of `fine`, cells of 3 cell_m and 0.5 m at least
};

/// Same bits for any thread count and order of the points. Throws Error(usage) for an empty cloud.
PreparedScan prepare_scan(const Cloud& scan, const PrepareOptions& options);

}  // namespace alea
