#include "alea/cloud/canonical_order.hpp"

#include <tbb/parallel_sort.h>

#include <numeric>
#include <tuple>

namespace alea {
namespace {

template <typename T>
T value_at(const std::vector<T>& values, std::uint32_t i) {
  return values.empty() ? T{} : values[i];
}

/// Everything but the position, compared only where two positions are equal.
bool rest_before(const Cloud& cloud, std::uint32_t a, std::uint32_t b) {
  const auto key = [&cloud](std::uint32_t i) {
    const Eigen::Vector3f normal =
        cloud.normals.empty() ? Eigen::Vector3f::Zero() : cloud.normals[i];
    return std::tuple(value_at(cloud.intensity, i), value_at(cloud.colours, i), normal.x(),
                      normal.y(), normal.z(), value_at(cloud.rows, i), value_at(cloud.columns, i));
  };
  return key(a) < key(b);
}

}  // namespace

Cloud canonical_order(const Cloud& cloud) {
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  tbb::parallel_sort(order.begin(), order.end(), [&cloud](std::uint32_t a, std::uint32_t b) {
    const Eigen::Vector3d& p = cloud.positions[a];
    const Eigen::Vector3d& q = cloud.positions[b];
    if (p.x() != q.x()) return p.x() < q.x();
    if (p.y() != q.y()) return p.y() < q.y();
    if (p.z() != q.z()) return p.z() < q.z();
    return rest_before(cloud, a, b);
  });
  Cloud sorted = subset(cloud, order);
  sorted.dropped = cloud.dropped;
  return sorted;
}

}  // namespace alea
