#include "alea/plane/cell_tree.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

// Exact sums of whole quanta: the same for any order of the points.
struct QuantaSums {
  std::int64_t x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

QuantaSums sums_of(std::span<const CellPoint> points) {
  QuantaSums s;
  for (const CellPoint& p : points) {
    const std::int64_t x = p.local[0];
    const std::int64_t y = p.local[1];
    const std::int64_t z = p.local[2];
    s.x += x;
    s.y += y;
    s.z += z;
    s.xx += x * x;
    s.xy += x * y;
    s.xz += x * z;
    s.yy += y * y;
    s.yz += y * z;
    s.zz += z * z;
  }
  return s;
}

PointMoments moments_of(std::span<const CellPoint> points, const Eigen::Vector3d& centre,
                        double quantum) {
  const QuantaSums s = sums_of(points);
  PointMoments m;
  m.count = static_cast<double>(points.size());
  const Eigen::Vector3d sum(static_cast<double>(s.x), static_cast<double>(s.y),
                            static_cast<double>(s.z));
  Eigen::Matrix3d squares;
  squares << static_cast<double>(s.xx), static_cast<double>(s.xy), static_cast<double>(s.xz),
      static_cast<double>(s.xy), static_cast<double>(s.yy), static_cast<double>(s.yz),
      static_cast<double>(s.xz), static_cast<double>(s.yz), static_cast<double>(s.zz);
  m.mean = centre + sum * (quantum / m.count);
  m.scatter = (squares - sum * sum.transpose() / m.count) * (quantum * quantum);
  return m;
}

// Builds the trees of consecutive cells; each chunk of cells has a builder of its own.
class TreeBuilder {
 public:
  TreeBuilder(CellGrid& grid, const TreeOptions& options) : grid_(grid), options_(options) {}

  void build(std::uint32_t cell) {
    cell_ = cell;
    const Cell& c = grid_.cells[cell];
    roots.push_back(divide(c.begin, c.end, 0, {0, 0, 0}));
  }

  std::vector<Leaf> leaves;
  std::vector<CellTree::Node> nodes;
  std::vector<std::int32_t> roots;

 private:
  std::int32_t divide(std::uint32_t begin, std::uint32_t end, int level,
                      const std::array<std::int32_t, 3>& place) {
    if (begin == end) return CellTree::empty;
    Leaf leaf = describe(begin, end, level, place);
    if (leaf.kind != LeafKind::mixed || level == options_.levels ||
        end - begin < 2 * options_.least_points) {
      leaves.push_back(leaf);
      return -1 - static_cast<std::int32_t>(leaves.size());
    }
    return halve(begin, end, level, place);
  }

  std::int32_t halve(std::uint32_t begin, std::uint32_t end, int level,
                     const std::array<std::int32_t, 3>& place) {
    const auto node = static_cast<std::int32_t>(nodes.size());
    nodes.emplace_back();
    constexpr std::int32_t half = 1 << (CellGrid::quantum_bits - 1);
    std::array<std::uint32_t, 9> border{};
    border[0] = begin;
    border[8] = end;
    for (int axis = 2, stride = 8; axis >= 0; --axis, stride /= 2) {
      const std::int32_t width = (2 * half) >> level;
      const std::int32_t middle = place[axis] * width + width / 2 - half;
      for (int first = 0; first < 8; first += stride)
        border[first + stride / 2] = partition(border[first], border[first + stride], axis, middle);
    }
    for (int octant = 0; octant < 8; ++octant) {
      const std::int32_t child =
          divide(border[octant], border[octant + 1], level + 1,
                 {2 * place[0] + (octant & 1), 2 * place[1] + (octant >> 1 & 1),
                  2 * place[2] + (octant >> 2)});
      nodes[node][octant] = child;
    }
    return node;
  }

  std::uint32_t partition(std::uint32_t begin, std::uint32_t end, int axis, std::int32_t middle) {
    const auto first = grid_.points.begin();
    const auto split = std::partition(first + begin, first + end,
                                      [&](const CellPoint& p) { return p.local[axis] < middle; });
    return static_cast<std::uint32_t>(split - first);
  }

  Leaf describe(std::uint32_t begin, std::uint32_t end, int level,
                const std::array<std::int32_t, 3>& place) const {
    const Cell& c = grid_.cells[cell_];
    Leaf leaf{cell_, begin, end, level, place, LeafKind::mixed, {}, {}};
    for (int axis = 0; axis < 3; ++axis) leaf.place[axis] += c.place[axis] << level;
    const std::span<const CellPoint> points(grid_.points.data() + begin, end - begin);
    leaf.moments = moments_of(points, grid_.centre(c), grid_.quantum());
    leaf.plane = plane_of(leaf.moments);
    if (end - begin < options_.least_points || leaf.plane.thickness > options_.tolerance / 2)
      return leaf;
    if (leaf.plane.breadth < std::max(options_.tolerance / 2, 2 * leaf.plane.thickness))
      leaf.kind = LeafKind::narrow;
    else if (few_strays(points, c, leaf))
      leaf.kind = LeafKind::planar;
    return leaf;
  }

  // A small facet hidden in a cell of a large plane barely thickens it, but its points stray.
  bool few_strays(std::span<const CellPoint> points, const Cell& c, const Leaf& leaf) const {
    const Eigen::Vector3d normal = leaf.plane.normal;
    const double quantum = grid_.quantum();
    const double offset = normal.dot(leaf.moments.mean - grid_.centre(c)) / quantum;
    const double band = options_.tolerance / quantum;
    std::size_t strays = 0;
    for (const CellPoint& p : points) {
      const double distance =
          normal.x() * p.local[0] + normal.y() * p.local[1] + normal.z() * p.local[2] - offset;
      strays += static_cast<std::size_t>(std::abs(distance) > band);
    }
    return 50 * strays <= points.size();
  }

  CellGrid& grid_;
  TreeOptions options_;
  std::uint32_t cell_ = 0;
};

// Appends the builder's part, its numbers moved behind those already there.
void append(CellTree& tree, const TreeBuilder& part) {
  const auto leaf_shift = static_cast<std::int32_t>(tree.leaves.size());
  const auto node_shift = static_cast<std::int32_t>(tree.nodes.size());
  const auto moved = [&](std::int32_t code) {
    if (code == CellTree::empty) return code;
    return code >= 0 ? code + node_shift : code - leaf_shift;
  };
  tree.leaves.insert(tree.leaves.end(), part.leaves.begin(), part.leaves.end());
  for (const CellTree::Node& node : part.nodes) {
    CellTree::Node copy{};
    std::transform(node.begin(), node.end(), copy.begin(), moved);
    tree.nodes.push_back(copy);
  }
  for (const std::int32_t root : part.roots) tree.roots.push_back(moved(root));
}

// The leaf of the same or a coarser level that covers the cube at `place` of `level`, or none.
std::uint32_t covering_leaf(const CellGrid& grid, const CellTree& tree, int level,
                            const std::array<std::int32_t, 3>& place) {
  // A shift of a negative number rounds down, so that a place before the grid stays there.
  const std::uint32_t cell =
      grid.cell_at({place[0] >> level, place[1] >> level, place[2] >> level});
  if (cell == CellTable::none) return CellTable::none;
  std::int32_t code = tree.roots[cell];
  for (int bit = level - 1; bit >= 0 && code >= 0; --bit)
    code = tree.nodes[code][(place[0] >> bit & 1) | (place[1] >> bit & 1) << 1 |
                            (place[2] >> bit & 1) << 2];
  return code <= -2 ? static_cast<std::uint32_t>(-2 - code) : CellTable::none;
}

using LeafPair = std::pair<std::uint32_t, std::uint32_t>;

// Every pair of touching leaves, at least once, from the side of the finer one.
void find_pairs(const CellGrid& grid, const CellTree& tree, std::uint32_t leaf,
                std::vector<LeafPair>& pairs) {
  const Leaf& from = tree.leaves[leaf];
  for (int step = 0; step < 27; ++step) {
    if (step == 13) continue;
    const std::array<std::int32_t, 3> place{from.place[0] + step % 3 - 1,
                                            from.place[1] + step / 3 % 3 - 1,
                                            from.place[2] + step / 9 - 1};
    const std::uint32_t to = covering_leaf(grid, tree, from.level, place);
    if (to != CellTable::none) pairs.emplace_back(leaf, to);
  }
}

}  // namespace

CellTree make_cell_tree(CellGrid& grid, const TreeOptions& options) {
  constexpr std::size_t chunk = 64;
  std::vector<TreeBuilder> parts((grid.cells.size() + chunk - 1) / chunk,
                                 TreeBuilder(grid, options));
  parallel_chunks(grid.cells.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      parts[begin / chunk].build(static_cast<std::uint32_t>(c));
  });
  CellTree tree;
  for (const TreeBuilder& part : parts) append(tree, part);
  return tree;
}

LeafAdjacency leaf_adjacency(const CellGrid& grid, const CellTree& tree) {
  constexpr std::size_t chunk = 512;
  const std::size_t count = tree.leaves.size();
  std::vector<std::vector<LeafPair>> parts((count + chunk - 1) / chunk);
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      find_pairs(grid, tree, static_cast<std::uint32_t>(leaf), parts[begin / chunk]);
  });
  std::vector<std::uint32_t> first(count + 1, 0);
  for (const auto& part : parts)
    for (const auto& [a, b] : part) ++first[a + 1], ++first[b + 1];
  for (std::size_t i = 0; i < count; ++i) first[i + 1] += first[i];
  std::vector<std::uint32_t> both(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const auto& part : parts)
    for (const auto& [a, b] : part) {
      both[next[a]++] = b;
      both[next[b]++] = a;
    }
  LeafAdjacency out;
  out.first.push_back(0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto begin = both.begin() + first[i];
    const auto end = both.begin() + first[i + 1];
    std::sort(begin, end);
    out.neighbours.insert(out.neighbours.end(), begin, std::unique(begin, end));
    out.first.push_back(static_cast<std::uint32_t>(out.neighbours.size()));
  }
  return out;
}

}  // namespace alea
