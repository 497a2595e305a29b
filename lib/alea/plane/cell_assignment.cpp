#include "alea/plane/cell_assignment.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

// A plane that may claim points of a leaf, where they lie in a box; all in quanta from the centre
// of the leaf's cell.
struct Candidate {
  std::int32_t plane;
  Eigen::Vector3d normal;
  double offset;
  bool everywhere;
  std::array<double, 3> low, high;
};

class Assignment {
 public:
  Assignment(const CellGrid& grid, const CellTree& tree, const LeafAdjacency& adjacency,
             const GrownPlanes& grown, double tolerance)
      : grid_(grid),
        tree_(tree),
        adjacency_(adjacency),
        grown_(grown),
        band_(tolerance / grid.quantum()) {}

  void assign(std::uint32_t leaf, std::vector<Candidate>& candidates,
              std::vector<std::int32_t>& plane_of_point) const {
    find_candidates(leaf, candidates);
    if (candidates.empty()) return;
    const Leaf& own = tree_.leaves[leaf];
    for (std::uint32_t k = own.begin; k < own.end; ++k)
      plane_of_point[grid_.points[k].index] = nearest(grid_.points[k], candidates);
  }

 private:
  Candidate candidate(std::int32_t plane, const Leaf& own) const {
    const GrownPlane& g = grown_.planes[plane];
    const Eigen::Vector3d centre = grid_.centre(grid_.cells[own.cell]);
    const double offset = g.plane.normal.dot(g.moments.mean - centre) / grid_.quantum();
    return {plane, g.plane.normal, offset, true, {}, {}};
  }

  void find_candidates(std::uint32_t leaf, std::vector<Candidate>& out) const {
    out.clear();
    const Leaf& own = tree_.leaves[leaf];
    const std::int32_t home = grown_.plane_of_leaf[leaf];
    if (home >= 0) out.push_back(candidate(home, own));
    for (std::uint32_t k = adjacency_.first[leaf]; k < adjacency_.first[leaf + 1]; ++k) {
      const std::uint32_t other = adjacency_.neighbours[k];
      const std::int32_t plane = grown_.plane_of_leaf[other];
      if (plane < 0 || plane == home) continue;
      Candidate next = candidate(plane, own);
      limit(next, own, tree_.leaves[other]);
      out.push_back(next);
    }
  }

  // The box of the neighbour, widened by the smaller leaf's edge.
  void limit(Candidate& c, const Leaf& own, const Leaf& other) const {
    constexpr double cell = 1 << CellGrid::quantum_bits;
    const double edge = std::ldexp(cell, -other.level);
    const double margin = std::ldexp(cell, -std::max(own.level, other.level));
    c.everywhere = false;
    for (int axis = 0; axis < 3; ++axis) {
      const double low =
          other.place[axis] * edge - (grid_.cells[own.cell].place[axis] + 0.5) * cell;
      c.low[axis] = low - margin;
      c.high[axis] = low + edge + margin;
    }
  }

  std::int32_t nearest(const CellPoint& p, const std::vector<Candidate>& candidates) const {
    std::int32_t best = -1;
    double least = band_;
    for (const Candidate& c : candidates) {
      const double distance = std::abs(c.normal.x() * p.local[0] + c.normal.y() * p.local[1] +
                                       c.normal.z() * p.local[2] - c.offset);
      if (distance > least || (distance == least && best >= 0)) continue;
      if (!c.everywhere && !inside(p, c)) continue;
      least = distance;
      best = c.plane;
    }
    return best;
  }

  static bool inside(const CellPoint& p, const Candidate& c) {
    bool in = true;
    for (int axis = 0; axis < 3; ++axis)
      in = in && p.local[axis] >= c.low[axis] && p.local[axis] <= c.high[axis];
    return in;
  }

  const CellGrid& grid_;
  const CellTree& tree_;
  const LeafAdjacency& adjacency_;
  const GrownPlanes& grown_;
  double band_;
};

}  // namespace

std::vector<std::int32_t> assign_points(const CellGrid& grid, const CellTree& tree,
                                        const LeafAdjacency& adjacency, const GrownPlanes& grown,
                                        double tolerance, std::size_t points) {
  std::vector<std::int32_t> plane_of_point(points, -1);
  const Assignment assignment(grid, tree, adjacency, grown, tolerance);
  parallel_chunks(tree.leaves.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<Candidate> candidates;
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      assignment.assign(static_cast<std::uint32_t>(leaf), candidates, plane_of_point);
  });
  return plane_of_point;
}

}  // namespace alea
