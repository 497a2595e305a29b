#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "alea/plane/cell_tree.hpp"

namespace alea {

/// A plane that leaves agree on, from the grid's anchor.
struct GrownPlane {
  PointMoments moments;
  MomentPlane plane;
  Eigen::AlignedBox3d box;  ///< of the means of its leaves
};

/// Whether one plane explains both sets: each has a root mean square distance of at most half the
/// tolerance from the plane of their union.
bool coplanar(const GrownPlane& a, const GrownPlane& b, double tolerance);

struct GrownPlanes {
  std::vector<GrownPlane> planes;
  std::vector<std::int32_t> plane_of_leaf;  ///< -1 where the leaf belongs to none
};

struct GrowthOptions {
  double tolerance = 0;
  double least_points = 0;  ///< planes with fewer in whole leaves are dropped
};

/// Grows planes over touching leaves from the largest and fullest planar ones, then joins touching
/// planes that one plane explains, and drops those too small or too narrow (standard deviation
/// along the shorter side below 2 tolerances). The order of events depends on the leaves alone.
GrownPlanes grow_planes(const CellTree& tree, const LeafAdjacency& adjacency,
                        const GrowthOptions& options);

}  // namespace alea
