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

  /// Leaves of no plane take the planes of their points as their own from now on.
  void learn(const PointLabels& labels) {
    guests_.resize(tree_.leaves.size());
    parallel_chunks(tree_.leaves.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t leaf = begin; leaf < end; ++leaf) {
        if (grown_.plane_of_leaf[leaf] >= 0) continue;
        std::vector<std::int32_t>& planes = guests_[leaf];
        for (std::uint32_t k = tree_.leaves[leaf].begin; k < tree_.leaves[leaf].end; ++k) {
          const std::int32_t plane = labels.plane[grid_.points[k].index];
          if (plane >= 0 && std::find(planes.begin(), planes.end(), plane) == planes.end())
            planes.push_back(plane);
        }
        std::sort(planes.begin(), planes.end());
      }
    });
  }

  void assign(std::uint32_t leaf, std::vector<Candidate>& candidates, PointLabels& labels) const {
    if (!find_candidates(leaf, candidates)) return;
    const Leaf& own = tree_.leaves[leaf];
    for (std::uint32_t k = own.begin; k < own.end; ++k) label(grid_.points[k], candidates, labels);
  }

 private:
  Candidate candidate(std::int32_t plane, const Leaf& own) const {
    const GrownPlane& g = grown_.planes[plane];
    const Eigen::Vector3d centre = grid_.centre(grid_.cells[own.cell]);
    const double offset = g.plane.normal.dot(g.moments.mean - centre) / grid_.quantum();
    return {plane, g.plane.normal, offset, true, {}, {}};
  }

  /// Whether there is anything to assign: a candidate, and after learning a new one.
  bool find_candidates(std::uint32_t leaf, std::vector<Candidate>& out) const {
    out.clear();
    const Leaf& own = tree_.leaves[leaf];
    const std::int32_t home = grown_.plane_of_leaf[leaf];
    if (home >= 0) out.push_back(candidate(home, own));
    bool news = guests_.empty();
    for (std::uint32_t k = adjacency_.first[leaf]; k < adjacency_.first[leaf + 1]; ++k) {
      const std::uint32_t other = adjacency_.neighbours[k];
      const std::int32_t plane = grown_.plane_of_leaf[other];
      if (plane >= 0 && plane != home) add_limited(plane, own, other, out);
      if (guests_.empty()) continue;
      for (const std::int32_t guest : guests_[other]) {
        if (guest == home) continue;
        add_limited(guest, own, other, out);
        news = true;
      }
    }
    return news && !out.empty();
  }

  void add_limited(std::int32_t plane, const Leaf& own, std::uint32_t other,
                   std::vector<Candidate>& out) const {
    out.push_back(candidate(plane, own));
    limit(out.back(), own, tree_.leaves[other]);
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

  void label(const CellPoint& p, const std::vector<Candidate>& candidates,
             PointLabels& labels) const {
    std::int32_t best = PointLabels::none;
    double least = band_;
    bool contested = false;
    for (const Candidate& c : candidates) {
      const double distance = std::abs(c.normal.x() * p.local[0] + c.normal.y() * p.local[1] +
                                       c.normal.z() * p.local[2] - c.offset);
      if (distance > band_ || (!c.everywhere && !inside(p, c))) continue;
      contested |= best >= 0 && c.plane != best;
      if (distance > least || (distance == least && best >= 0)) continue;
      least = distance;
      best = c.plane;
    }
    labels.plane[p.index] = best;
    labels.contested[p.index] = contested;
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
  std::vector<std::vector<std::int32_t>> guests_;
};

}  // namespace

PointLabels assign_points(const CellGrid& grid, const CellTree& tree,
                          const LeafAdjacency& adjacency, const GrownPlanes& grown,
                          double tolerance, std::size_t points) {
  PointLabels labels(points);
  Assignment assignment(grid, tree, adjacency, grown, tolerance);
  const auto assign_all = [&] {
    parallel_chunks(tree.leaves.size(), 256, [&](std::size_t begin, std::size_t end) {
      std::vector<Candidate> candidates;
      for (std::size_t leaf = begin; leaf < end; ++leaf)
        assignment.assign(static_cast<std::uint32_t>(leaf), candidates, labels);
    });
  };
  assign_all();
  assignment.learn(labels);
  assign_all();
  return labels;
}

}  // namespace alea
