#include "alea/cloud/canonical_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include "alea/cloud/attribute.hpp"

namespace alea {
namespace {

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

bool before(const Cloud& cloud, std::uint32_t a, std::uint32_t b) {
  const Eigen::Vector3d& p = cloud.positions[a];
  const Eigen::Vector3d& q = cloud.positions[b];
  if (p.x() != q.x()) return p.x() < q.x();
  if (p.y() != q.y()) return p.y() < q.y();
  if (p.z() != q.z()) return p.z() < q.z();
  return rest_before(cloud, a, b);
}

/// A point's x as a whole number that never falls where x rises (upper half), and its index.
using Keyed = std::uint64_t;

std::vector<Keyed> keyed_by_x(const Cloud& cloud) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector3d& p : cloud.positions)
    if (std::isfinite(p.x())) low = std::min(low, p.x()), high = std::max(high, p.x());
  const double scale = high > low ? 4294967295.0 / (high - low) : 0;
  std::vector<Keyed> keys;
  keys.reserve(cloud.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const double steps = (cloud.positions[i].x() - low) * scale;
    const double key = std::isnan(steps) ? 0 : std::clamp(steps, 0.0, 4294967295.0);
    keys.push_back(static_cast<Keyed>(key) << 32 | i);
  }
  return keys;
}

/// Sorts by the upper halves, eleven bits at a time from the lowest: linear in the points.
void sort_by_key(std::vector<Keyed>& keys) {
  constexpr int bits = 11;
  constexpr std::size_t classes = std::size_t{1} << bits;
  std::vector<Keyed> other(keys.size());
  for (int shift = 32; shift < 64; shift += bits) {
    const auto class_of = [shift](Keyed key) { return key >> shift & (classes - 1); };
    std::array<std::size_t, classes> next{};
    for (const Keyed key : keys) ++next[class_of(key)];
    std::size_t begin = 0;
    for (std::size_t& place : next) begin += std::exchange(place, begin);
    for (const Keyed key : keys) other[next[class_of(key)]++] = key;
    keys.swap(other);
  }
}

}  // namespace

Cloud canonical_order(const Cloud& cloud) {
  std::vector<Keyed> keys = keyed_by_x(cloud);
  sort_by_key(keys);
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const Keyed key : keys) order.push_back(static_cast<std::uint32_t>(key));
  const auto comes_before = [&cloud](std::uint32_t a, std::uint32_t b) {
    return before(cloud, a, b);
  };
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && keys[end] >> 32 == keys[begin] >> 32) ++end;
    if (end - begin > 1)
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                order.begin() + static_cast<std::ptrdiff_t>(end), comes_before);
  }
  Cloud sorted = subset(cloud, order);
  sorted.dropped = cloud.dropped;
  return sorted;
}

Cloud without_duplicates(Cloud sorted) {
  const auto repeats = [&sorted](std::uint32_t i) {
    return sorted.positions[i] == sorted.positions[i - 1] &&
           value_at(sorted.intensity, i) == value_at(sorted.intensity, i - 1) &&
           value_at(sorted.colours, i) == value_at(sorted.colours, i - 1);
  };
  std::vector<std::uint32_t> kept;
  kept.reserve(sorted.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i)
    if (i == 0 || !repeats(i)) kept.push_back(i);
  if (kept.size() == sorted.size()) return sorted;
  Cloud out = subset(sorted, kept);
  out.dropped = sorted.dropped;
  return out;
}

}  // namespace alea
