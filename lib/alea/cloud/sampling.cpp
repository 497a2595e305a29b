#include "alea/cloud/sampling.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

#include "alea/cloud/kd_order.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

std::uint64_t split_mixed(std::uint64_t value) {  // the finaliser of SplitMix64
  value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9ull;
  value = (value ^ value >> 27) * 0x94D049BB133111EBull;
  return value ^ value >> 31;
}

/// A random number that belongs to a place in space, so that the order of the points has no part.
std::uint64_t draw(const Eigen::Vector3d& p, std::uint64_t seed) {
  std::uint64_t value = split_mixed(seed + 0x9E3779B97F4A7C15ull);
  for (int i = 0; i < 3; ++i) value = split_mixed(value ^ std::bit_cast<std::uint64_t>(p[i] + 0.0));
  return value;
}

Cloud without_grid(Cloud cloud, const Cloud& from) {
  cloud.rows.clear();
  cloud.columns.clear();
  cloud.dropped = {};
  cloud.scanner_position = from.scanner_position;
  return cloud;
}

}  // namespace

Cloud random_sample(const Cloud& cloud, std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> chosen(cloud.size());
  std::iota(chosen.begin(), chosen.end(), 0u);
  if (count < cloud.size()) {
    std::vector<std::uint64_t> draws(cloud.size());
    parallel_chunks(cloud.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) draws[i] = draw(cloud.positions[i], seed);
    });
    std::nth_element(chosen.begin(), chosen.begin() + static_cast<long>(count), chosen.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::tie(draws[a], a) < std::tie(draws[b], b);
                     });
    chosen.resize(count);
    std::sort(chosen.begin(), chosen.end());
  }
  return without_grid(subset(cloud, chosen), cloud);
}

Cloud non_uniform_grid_sample(const Cloud& cloud, std::size_t leaf_size, std::uint64_t seed) {
  const KdOrder order = kd_order(cloud.positions, leaf_size);
  std::vector<std::uint32_t> chosen;
  for (std::size_t leaf = 0; leaf < order.leaves(); ++leaf) {
    const std::size_t first = order.first(order.levels, leaf);
    const std::size_t last = order.first(order.levels, leaf + 1);
    if (first == last) continue;
    std::size_t best = first;
    for (std::size_t i = first + 1; i < last; ++i)
      if (draw(order.points[i].position, seed) < draw(order.points[best].position, seed)) best = i;
    chosen.push_back(order.points[best].index);
  }
  return without_grid(subset(cloud, chosen), cloud);
}

}  // namespace alea
