#include "alea/cloud/spatial_order.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

#include "alea/cloud/attribute.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr int bits_per_axis = 21;

/// The lowest 21 bits of v, each followed by two zeros.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

struct Place {
  std::uint64_t cell;
  std::uint32_t index;
};

bool coordinates_before(const Cloud& cloud, std::uint32_t a, std::uint32_t b) {
  const auto key = [&cloud](std::uint32_t i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    const Eigen::Vector3f n = cloud.normals.empty() ? Eigen::Vector3f::Zero() : cloud.normals[i];
    return std::tuple(p.x(), p.y(), p.z(), value_at(cloud.intensity, i), n.x(), n.y(), n.z(),
                      value_at(cloud.colours, i));
  };
  return key(a) < key(b);
}

}  // namespace

std::vector<std::uint32_t> spatial_order(const Cloud& cloud) {
  if (cloud.empty()) return {};
  Eigen::Vector3d low = cloud.positions[0], high = low;
  for (const Eigen::Vector3d& p : cloud.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = std::max((high - low).maxCoeff(), 1e-12);
  const double scale = ((1ull << bits_per_axis) - 1) / extent;
  std::vector<Place> places(cloud.size());
  parallel_chunks(cloud.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d at = (cloud.positions[i] - low) * scale;
      std::uint64_t cell = 0;
      for (int a = 0; a < 3; ++a) cell |= spread(static_cast<std::uint64_t>(at[a])) << a;
      places[i] = {cell, static_cast<std::uint32_t>(i)};
    }
  });
  tbb::parallel_sort(places.begin(), places.end(), [&cloud](const Place& a, const Place& b) {
    return a.cell != b.cell ? a.cell < b.cell : coordinates_before(cloud, a.index, b.index);
  });
  std::vector<std::uint32_t> order(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) order[i] = places[i].index;
  return order;
}

}  // namespace alea
