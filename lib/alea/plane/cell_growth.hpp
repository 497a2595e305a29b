#pragma once

#include <cstdint>
#include <vector>

#include "alea/plane/cell_tree.hpp"

namespace alea {

/// A plane that leaves agree on, from the grid's anchor.
struct GrownPlane {
  PointMoments moments;
  MomentPlane plane;
};

struct GrownPlanes {
  std::vector<GrownPlane> planes;
  std::vector<std::int32_t> plane_of_leaf;  ///< -1 where the leaf belongs to none
};

struct GrowthOptions {
  double tolerance = 0;
  double least_points = 0;  ///< planes with fewer in whole leaves are dropped
};

/// Grows planes over touching leaves from the largest and fullest planar ones, then joins touching
/// planes that one plane explains. The order of events depends on the leaves alone.
GrownPlanes grow_planes(const CellTree& tree, const LeafAdjacency& adjacency,
                        const GrowthOptions& options);

}  // namespace alea
