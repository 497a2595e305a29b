#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace alea {

/// A point and its index in the cloud that it comes from.
struct KdPoint {
  Eigen::Vector3d position;  ///< m
  std::uint32_t index;
};

/// Where an inner node cuts: no point on its left lies above `low_m` along `axis`, none on its
/// right below `high_m`.
struct KdSplit {
  double low_m = 0;
  double high_m = 0;
  int axis = 0;
};

/// Points in the order of the leaves of a balanced k-d tree: neighbours in space are neighbours in
/// memory. Node j of level l (2^l nodes) holds the places [first(l, j), first(l, j + 1)); its
/// children are nodes 2j and 2j + 1 of the next level. The order depends on the coordinates alone,
/// points at one place excepted, which follow their index.
struct KdOrder {
  std::vector<KdPoint> points;
  std::vector<KdSplit> splits;  ///< node j of level l at 2^l - 1 + j
  int levels = 0;               ///< the leaves are the nodes of this level

  std::size_t leaves() const { return std::size_t{1} << levels; }
  std::size_t first(int level, std::size_t node) const { return (points.size() * node) >> level; }
};

/// Halves the points along their widest axis until no leaf has more than `leaf_size` points (>= 1).
/// Parallel; the same bits for any thread count. Throws Error(usage) for leaf_size = 0 or 2^32
/// points and more. Bentley 1975, Multidimensional binary search trees, Comm. ACM 18(9), 509-517.
KdOrder kd_order(std::span<const Eigen::Vector3d> points, std::size_t leaf_size);

}  // namespace alea
