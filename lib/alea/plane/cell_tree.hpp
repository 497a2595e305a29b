#pragma once

#include <cstdint>
#include <vector>

#include "alea/plane/cell_grid.hpp"
#include "alea/plane/point_moments.hpp"

namespace alea {

/// What the points of a leaf look like.
enum class LeafKind : std::uint8_t {
  planar,  ///< flat and broad: has a plane of its own
  narrow,  ///< flat, but hardly more than a line: fits any plane through it
  mixed    ///< an edge, a corner, clutter, or too few points
};

/// An undivided cube of the octree below a cell of the grid.
struct Leaf {
  std::uint32_t cell;
  std::uint32_t begin;  ///< of its points in CellGrid::points
  std::uint32_t end;
  int level;                          ///< edge = cell / 2^level
  std::array<std::int32_t, 3> place;  ///< in the grid of its level
  LeafKind kind;
  PointMoments moments;  ///< from the grid's anchor
  MomentPlane plane;
};

struct TreeOptions {
  double tolerance = 0;
  int levels = 0;                  ///< how often a cell may be halved
  std::uint32_t least_points = 6;  ///< a leaf with fewer is mixed
};

/// Octrees below the cells of a grid: a cell is halved until its points are flat.
struct CellTree {
  /// Children of a node: empty, a leaf (-2 - index) or a node (index).
  using Node = std::array<std::int32_t, 8>;
  static constexpr std::int32_t empty = -1;

  std::vector<Leaf> leaves;  ///< by cell, then by octant
  std::vector<Node> nodes;
  std::vector<std::int32_t> roots;  ///< for each cell, coded like a child
};

/// Reorders the points within each cell so that every leaf's are consecutive.
CellTree make_cell_tree(CellGrid& grid, const TreeOptions& options);

/// Leaves that touch each other (by face, edge or corner), both ways, ascending.
struct LeafAdjacency {
  std::vector<std::uint32_t>
      first;  ///< leaf i has neighbours[first[i]] to neighbours[first[i+1]-1]
  std::vector<std::uint32_t> neighbours;
};

LeafAdjacency leaf_adjacency(const CellGrid& grid, const CellTree& tree);

}  // namespace alea
