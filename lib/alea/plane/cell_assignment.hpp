#pragma once

#include <cstdint>
#include <vector>

#include "alea/plane/cell_growth.hpp"

namespace alea {

/// The plane of each of `points` points of the cloud, or -1: the nearest within `tolerance` of
/// those that the point's own leaf and the leaves around it belong to. A neighbour's plane counts
/// only for points within one (smaller) leaf of that neighbour, so that a facet does not creep
/// along its own extension over the floor.
std::vector<std::int32_t> assign_points(const CellGrid& grid, const CellTree& tree,
                                        const LeafAdjacency& adjacency, const GrownPlanes& grown,
                                        double tolerance, std::size_t points);

}  // namespace alea
