#include "alea/cloud/kd_order.hpp"

#include <algorithm>
#include <limits>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

/// Every axis in turn, beginning with one, then the index: no two points are equal.
struct Before {
  int axis;
  bool operator()(const KdPoint& a, const KdPoint& b) const {
    if (a.position[axis] != b.position[axis]) return a.position[axis] < b.position[axis];
    for (int i = 0; i < 3; ++i)
      if (a.position[i] != b.position[i]) return a.position[i] < b.position[i];
    return a.index < b.index;
  }
};

int widest_axis(std::span<const KdPoint> points) {
  Eigen::Vector3d low = points[0].position, high = low;
  for (const KdPoint& p : points) {
    low = low.cwiseMin(p.position);
    high = high.cwiseMax(p.position);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

void split(KdOrder& order, int level, std::size_t node) {
  const std::size_t first = order.first(level, node), last = order.first(level, node + 1);
  const auto begin = order.points.begin();
  if (level == order.levels) {
    std::sort(begin + static_cast<long>(first), begin + static_cast<long>(last), Before{0});
    return;
  }
  const std::size_t middle = order.first(level + 1, 2 * node + 1);
  if (first < middle && middle < last) {
    const int axis = widest_axis(std::span(order.points).subspan(first, last - first));
    std::nth_element(begin + static_cast<long>(first), begin + static_cast<long>(middle),
                     begin + static_cast<long>(last), Before{axis});
    double low = -std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < middle; ++i)
      low = std::max(low, order.points[i].position[axis]);
    order.splits[(std::size_t{1} << level) - 1 + node] = {low, order.points[middle].position[axis],
                                                          axis};
  }
  const auto left = [&] { split(order, level + 1, 2 * node); };
  const auto right = [&] { split(order, level + 1, 2 * node + 1); };
  if (last - first > 8192) {
    parallel_pair(left, right);
  } else {
    left();
    right();
  }
}

}  // namespace

KdOrder kd_order(std::span<const Eigen::Vector3d> points, std::size_t leaf_size) {
  if (leaf_size == 0) throw usage_error("k-d tree: a leaf needs room for at least one point");
  if (points.size() > std::numeric_limits<std::uint32_t>::max())
    throw usage_error("k-d tree: more points than 32-bit indices; sample the cloud first");
  KdOrder order;
  order.points.resize(points.size());
  parallel_chunks(points.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      order.points[i] = {points[i], static_cast<std::uint32_t>(i)};
  });
  while (((points.size() + order.leaves() - 1) >> order.levels) > leaf_size) ++order.levels;
  order.splits.resize(order.leaves() - 1);
  if (!points.empty()) split(order, 0, 0);
  return order;
}

}  // namespace alea
