#pragma once

#include <cstddef>
#include <cstdint>

#include "alea/core/cloud.hpp"

namespace alea {

// Each sampling carries intensity, normals and colours along, and gives the same points for any
// thread count and any order of the input. Rows and columns are dropped: a sampled scan is no grid.

/// `count` points of the cloud (all of it where it has fewer), each point as likely as any other.
/// They keep their order.
Cloud random_sample(const Cloud& cloud, std::size_t count, std::uint64_t seed);

/// One point for each occupied cell of a cubic grid that begins at the cloud's least corner: the
/// mean of the cell's positions, intensities, colours and normals (scaled to unit length). Points
/// in the order of the cells: by z, then y, then x. Throws Error(usage) for a cell size that is not
/// positive, or so small that an axis has more than 2^21 cells.
Cloud grid_average(const Cloud& cloud, double cell_m);

/// One point for each leaf of a balanced k-d tree whose leaves hold at most `leaf_size` points (>=
/// 1): a point of the leaf chosen at random. Dense places keep proportionally more points.
Cloud non_uniform_grid_sample(const Cloud& cloud, std::size_t leaf_size, std::uint64_t seed);

}  // namespace alea
