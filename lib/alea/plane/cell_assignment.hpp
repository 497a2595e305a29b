#pragma once

#include "alea/plane/cell_growth.hpp"
#include "alea/plane/region_fit.hpp"

namespace alea {

/// Labels of `points` points of the cloud. The plane of a point is the nearest within `tolerance`
/// of those that the point's own leaf and the leaves around it belong to. A neighbour's plane
/// counts only for points within one (smaller) leaf of that neighbour, so that a facet does not
/// creep along its own extension over the floor.
PointLabels assign_points(const CellGrid& grid, const CellTree& tree,
                          const LeafAdjacency& adjacency, const GrownPlanes& grown,
                          double tolerance, std::size_t points);

}  // namespace alea
