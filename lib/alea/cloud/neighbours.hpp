#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "alea/cloud/kd_order.hpp"

namespace alea {

struct Neighbour {
  std::uint32_t index = 0;
  double squared_distance_m2 = 0;
};

/// A k-d tree over a copy of the points. Queries are thread-safe; which of several points at one
/// distance comes first depends on their coordinates, not on their order in the cloud (points at
/// one place excepted, which follow their index).
class NeighbourIndex {
 public:
  /// points: #points by 3, metres.
  explicit NeighbourIndex(std::span<const Eigen::Vector3d> points);

  /// Up to k neighbours, nearest first (the point itself included if it is one of the points).
  std::vector<Neighbour> nearest(const Eigen::Vector3d& point, std::size_t k) const;
  /// The same into `out`, k = out.size(), without memory of its own; returns how many there are.
  std::size_t nearest(const Eigen::Vector3d& point, std::span<Neighbour> out) const;
  /// The same with places in `order()` instead of indices: for sweeps over all points.
  std::size_t nearest_places(const Eigen::Vector3d& point, std::span<Neighbour> out) const;
  /// The nearest point that is no farther than `distance_m`.
  std::optional<Neighbour> nearest_one(
      const Eigen::Vector3d& point,
      double distance_m = std::numeric_limits<double>::infinity()) const;
  /// All neighbours within a distance (m), nearest first.
  std::vector<Neighbour> within(const Eigen::Vector3d& point, double distance_m) const;

  /// The points in the order of the tree's leaves: queries in this order find the cache warm.
  const KdOrder& order() const { return order_; }

 private:
  KdOrder order_;
};

}  // namespace alea
