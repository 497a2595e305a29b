#include "alea/plane/cell_growth.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace alea {
namespace {

constexpr std::int32_t no_plane = -1;
// Below this cosine (30 deg) a leaf with a plane of its own is of another facet.
constexpr double least_cosine = 0.866;
// In tolerances: the leaves along a sharp edge fit a bevel of one to two tolerances in breadth.
constexpr double least_breadth = 2;

bool fits(const PointMoments& moments, const MomentPlane& plane, const Eigen::Vector3d& point,
          double tolerance) {
  return moments.mean_square_distance(plane.normal, point) <= tolerance * tolerance / 4;
}

GrownPlane united(const GrownPlane& a, const GrownPlane& b) {
  GrownPlane out;
  out.moments = merged(a.moments, b.moments);
  out.plane = plane_of(out.moments);
  out.box = a.box.merged(b.box);
  return out;
}

class Growth {
 public:
  Growth(const CellTree& tree, const LeafAdjacency& adjacency, const GrowthOptions& options)
      : tree_(tree), adjacency_(adjacency), options_(options) {
    plane_of_leaf_.assign(tree.leaves.size(), no_plane);
  }

  GrownPlanes run() {
    for (const std::uint32_t seed : seeds())
      if (plane_of_leaf_[seed] == no_plane) grow(seed);
    join();
    return collect();
  }

 private:
  // Coarse leaves first: they lie inside facets; then full ones.
  std::vector<std::uint32_t> seeds() const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < tree_.leaves.size(); ++i)
      if (tree_.leaves[i].kind == LeafKind::planar) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Leaf& left = tree_.leaves[a];
      const Leaf& right = tree_.leaves[b];
      if (left.level != right.level) return left.level < right.level;
      return left.end - left.begin > right.end - right.begin;
    });
    return order;
  }

  void grow(std::uint32_t seed) {
    const auto id = static_cast<std::int32_t>(planes_.size());
    const Leaf& first = tree_.leaves[seed];
    GrownPlane grown{first.moments, first.plane, Eigen::AlignedBox3d(first.moments.mean)};
    double fitted_count = grown.moments.count;
    std::vector<std::uint32_t> queue{seed};
    plane_of_leaf_[seed] = id;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const std::uint32_t from = queue[next];
      for (std::uint32_t k = adjacency_.first[from]; k < adjacency_.first[from + 1]; ++k) {
        const std::uint32_t to = adjacency_.neighbours[k];
        if (plane_of_leaf_[to] != no_plane || !belongs(tree_.leaves[to], grown)) continue;
        plane_of_leaf_[to] = id;
        queue.push_back(to);
        grown.moments = merged(grown.moments, tree_.leaves[to].moments);
        grown.box.extend(tree_.leaves[to].moments.mean);
        if (grown.moments.count < 1.2 * fitted_count) continue;
        grown.plane = plane_of(grown.moments);
        fitted_count = grown.moments.count;
      }
    }
    grown.plane = plane_of(grown.moments);
    planes_.push_back(grown);
  }

  bool belongs(const Leaf& leaf, const GrownPlane& grown) const {
    if (leaf.kind == LeafKind::mixed) return false;
    if (leaf.kind == LeafKind::planar &&
        std::abs(leaf.plane.normal.dot(grown.plane.normal)) < least_cosine)
      return false;
    return fits(leaf.moments, grown.plane, grown.moments.mean, options_.tolerance);
  }

  // Pairs of planes whose leaves touch, ascending.
  std::vector<std::pair<std::int32_t, std::int32_t>> touching() const {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::uint32_t a = 0; a < tree_.leaves.size(); ++a)
      for (std::uint32_t k = adjacency_.first[a]; k < adjacency_.first[a + 1]; ++k) {
        const std::int32_t p = plane_of_leaf_[a];
        const std::int32_t q = plane_of_leaf_[adjacency_.neighbours[k]];
        if (p != no_plane && q != no_plane && p < q) pairs.emplace_back(p, q);
      }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  std::int32_t root(std::int32_t plane) const {
    while (parent_[plane] != plane) plane = parent_[plane];
    return plane;
  }

  void join() {
    parent_.resize(planes_.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    const auto pairs = touching();
    for (bool joined = true; joined;) {
      joined = false;
      for (const auto& [a, b] : pairs) {
        const std::int32_t p = std::min(root(a), root(b));
        const std::int32_t q = std::max(root(a), root(b));
        if (p == q) continue;
        if (!coplanar(planes_[p], planes_[q], options_.tolerance)) continue;
        planes_[p] = united(planes_[p], planes_[q]);
        parent_[q] = p;
        joined = true;
      }
    }
  }

  GrownPlanes collect() const {
    GrownPlanes out;
    std::vector<std::int32_t> number(planes_.size(), no_plane);
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      if (parent_[p] != static_cast<std::int32_t>(p)) continue;
      if (planes_[p].moments.count < options_.least_points ||
          planes_[p].plane.breadth < least_breadth * options_.tolerance)
        continue;
      number[p] = static_cast<std::int32_t>(out.planes.size());
      out.planes.push_back(planes_[p]);
    }
    out.plane_of_leaf.reserve(plane_of_leaf_.size());
    for (const std::int32_t p : plane_of_leaf_)
      out.plane_of_leaf.push_back(p == no_plane ? no_plane : number[root(p)]);
    return out;
  }

  const CellTree& tree_;
  const LeafAdjacency& adjacency_;
  GrowthOptions options_;
  std::vector<GrownPlane> planes_;
  std::vector<std::int32_t> plane_of_leaf_;
  std::vector<std::int32_t> parent_;
};

}  // namespace

bool coplanar(const GrownPlane& a, const GrownPlane& b, double tolerance) {
  const GrownPlane both = united(a, b);
  return fits(a.moments, both.plane, both.moments.mean, tolerance) &&
         fits(b.moments, both.plane, both.moments.mean, tolerance);
}

GrownPlanes grow_planes(const CellTree& tree, const LeafAdjacency& adjacency,
                        const GrowthOptions& options) {
  return Growth(tree, adjacency, options).run();
}

}  // namespace alea
