#include "alea/cloud/spacing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t sample_size = 1000;

std::uint64_t murmur_mixed(std::uint64_t value) {
  value ^= value >> 33;
  value *= 0xff51afd7ed558ccdULL;
  value ^= value >> 33;
  value *= 0xc4ceb9fe1a85ec53ULL;
  return value ^ value >> 33;
}

std::uint64_t hash_of(const Eigen::Vector3d& p) {
  std::uint64_t hash = 0;
  for (const double value : p) hash = murmur_mixed(hash + std::bit_cast<std::uint64_t>(value));
  return hash;
}

std::uint64_t hash_of(const std::array<std::int64_t, 3>& cell) {
  std::uint64_t hash = 0;
  for (const std::int64_t value : cell)
    hash = murmur_mixed(hash + static_cast<std::uint64_t>(value));
  return hash;
}

std::vector<Eigen::Vector3d> sample_of(const Cloud& cloud) {
  const std::uint64_t limit =
      std::max<std::uint64_t>(1, std::numeric_limits<std::uint64_t>::max() / cloud.size());
  std::vector<Eigen::Vector3d> sample;
  if (cloud.size() <= sample_size) return cloud.positions;
  for (const Eigen::Vector3d& p : cloud.positions)
    if (hash_of(p) / sample_size < limit) sample.push_back(p);
  return sample;
}

// The seeds that still look for a neighbour, in a hashed grid: a seed stands in its own cell and in
// the 26 around it, so that one look-up finds all seeds near a point.
class SeedGrid {
 public:
  SeedGrid(const std::vector<Eigen::Vector3d>& seeds, const std::vector<std::uint32_t>& open,
           double cell_m)
      : cell_m_(cell_m), buckets_(std::bit_ceil(64 * open.size())) {
    for (const std::uint32_t seed : open) {
      const auto [x, y, z] = cell_of(seeds[seed]);
      for (int d = 0; d < 27; ++d)
        bucket({x + d % 3 - 1, y + d / 3 % 3 - 1, z + d / 9 - 1}).push_back(seed);
    }
  }

  const std::vector<std::uint32_t>& near(const Eigen::Vector3d& p) const {
    return buckets_[hash_of(cell_of(p)) & (buckets_.size() - 1)];
  }

 private:
  std::array<std::int64_t, 3> cell_of(const Eigen::Vector3d& p) const {
    std::array<std::int64_t, 3> cell{};
    for (int i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(std::clamp(std::floor(p[i] / cell_m_), -4e18, 4e18));
    return cell;
  }
  std::vector<std::uint32_t>& bucket(const std::array<std::int64_t, 3>& cell) {
    return buckets_[hash_of(cell) & (buckets_.size() - 1)];
  }

  double cell_m_;
  std::vector<std::vector<std::uint32_t>> buckets_;
};

// Lowers the squared distance of each open seed to its nearest other point.
void search(const Cloud& cloud, const std::vector<Eigen::Vector3d>& seeds, const SeedGrid& grid,
            std::vector<double>& squared) {
  std::mutex mutex;
  parallel_chunks(cloud.size(), 1 << 18, [&](std::size_t begin, std::size_t end) {
    std::vector<double> here(seeds.size(), infinity);
    for (std::size_t i = begin; i < end; ++i) {
      for (const std::uint32_t seed : grid.near(cloud.positions[i])) {
        const double d = (cloud.positions[i] - seeds[seed]).squaredNorm();
        if (d > 0 && d < here[seed]) here[seed] = d;
      }
    }
    const std::lock_guard lock(mutex);
    for (std::size_t s = 0; s < seeds.size(); ++s) squared[s] = std::min(squared[s], here[s]);
  });
}

double extent_m(const Cloud& cloud) {
  Eigen::Vector3d low = cloud.positions[0];
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : cloud.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

}  // namespace

std::optional<double> median_spacing_m(const Cloud& cloud) {
  if (cloud.size() < 2) return std::nullopt;
  const double extent = extent_m(cloud);
  if (!(extent > 0) || !std::isfinite(extent)) return std::nullopt;
  const std::vector<Eigen::Vector3d> seeds = sample_of(cloud);
  std::vector<double> squared(seeds.size(), infinity);
  std::vector<std::uint32_t> open(seeds.size());
  for (std::uint32_t i = 0; i < open.size(); ++i) open[i] = i;
  // The points of a scan lie on surfaces: start from a surface's spacing, then widen.
  double cell_m = extent / std::sqrt(static_cast<double>(cloud.size()));
  for (; open.size() * 2 > seeds.size(); cell_m *= 3) {
    search(cloud, seeds, SeedGrid(seeds, open, cell_m), squared);
    // A neighbour within one cell is the nearest for certain.
    std::erase_if(open, [&](std::uint32_t s) { return squared[s] <= cell_m * cell_m; });
  }
  // More than half are settled within a cell and the rest are farther: the median is certain.
  std::nth_element(squared.begin(), squared.begin() + static_cast<long>(squared.size() - 1) / 2,
                   squared.end());
  return std::sqrt(squared[(squared.size() - 1) / 2]);
}

}  // namespace alea
