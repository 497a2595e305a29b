#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace alea {

struct Neighbour {
  std::uint32_t index = 0;
  double squared_distance_m2 = 0;
};

/// A k-d tree over points that must outlive it. Queries are thread-safe; equal distances are
/// ordered by index.
class NeighbourIndex {
 public:
  /// points: #points by 3, metres.
  explicit NeighbourIndex(std::span<const Eigen::Vector3d> points);
  ~NeighbourIndex();
  NeighbourIndex(NeighbourIndex&&) noexcept;
  NeighbourIndex& operator=(NeighbourIndex&&) noexcept;

  /// Up to k neighbours, nearest first (the point itself included if it is one of the points).
  std::vector<Neighbour> nearest(const Eigen::Vector3d& point, std::size_t k) const;
  /// All neighbours within a distance (m), nearest first.
  std::vector<Neighbour> within(const Eigen::Vector3d& point, double distance_m) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace alea
