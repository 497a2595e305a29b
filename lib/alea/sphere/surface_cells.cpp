#include "alea/sphere/surface_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr int bits = 21;
constexpr std::int64_t bias = std::int64_t{1} << (bits - 1);
constexpr std::uint64_t no_key = ~std::uint64_t{0};

std::uint64_t pack(std::int64_t x, std::int64_t y, std::int64_t z) {
  return static_cast<std::uint64_t>(((z + bias) << (2 * bits)) | ((y + bias) << bits) | (x + bias));
}

/// The distance between the keys of two cells that are (0, dy, dz) apart.
std::int64_t key_step(int dy, int dz) {
  return dz * (std::int64_t{1} << (2 * bits)) + dy * (std::int64_t{1} << bits);
}

std::uint64_t key_of(const Eigen::Vector3d& offset, double cell_m) {
  const Eigen::Vector3d cell = (offset / cell_m).array().floor();
  if (!(cell.cwiseAbs().maxCoeff() < static_cast<double>(bias - 2))) return no_key;
  return pack(static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
              static_cast<std::int64_t>(cell.z()));
}

struct Entry {
  std::uint64_t key;
  std::uint32_t index;
};

}  // namespace

SurfaceCells surface_cells(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& origin_m,
                           double cell_m) {
  std::vector<Entry> entries(points.size());
  parallel_chunks(points.size(), 1 << 15, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      entries[i] = {key_of(points[i] - origin_m, cell_m), static_cast<std::uint32_t>(i)};
  });
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    if (a.key != b.key) return a.key < b.key;
    const Eigen::Vector3d &p = points[a.index], &q = points[b.index];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  SurfaceCells cells{cell_m, origin_m, {}, {}, {}};
  for (const Entry& entry : entries) {
    if (entry.key == no_key) break;
    if (cells.keys.empty() || cells.keys.back() != entry.key) {
      cells.keys.push_back(entry.key);
      cells.first.push_back(static_cast<std::uint32_t>(cells.order.size()));
    }
    cells.order.push_back(entry.index);
  }
  cells.first.push_back(static_cast<std::uint32_t>(cells.order.size()));
  return cells;
}

WindowWalk::WindowWalk(const std::vector<std::uint64_t>& keys, std::size_t start)
    : keys_(keys), cell_(start), window_{} {
  if (start >= keys.size()) return;
  for (int row = 0; row < 9; ++row) {
    const std::uint64_t low =
        keys[start] + static_cast<std::uint64_t>(key_step(row % 3 - 1, row / 3 - 1)) - 1;
    const auto from = std::lower_bound(keys.begin(), keys.end(), low) - keys.begin();
    window_[row] = {static_cast<std::size_t>(from), static_cast<std::size_t>(from)};
  }
}

CellWindow WindowWalk::next() {
  for (int row = 0; row < 9; ++row) {
    const std::uint64_t middle =
        keys_[cell_] + static_cast<std::uint64_t>(key_step(row % 3 - 1, row / 3 - 1));
    CellRun& run = window_[row];
    while (run.begin < keys_.size() && keys_[run.begin] < middle - 1) ++run.begin;
    run.end = std::max(run.end, run.begin);
    while (run.end < keys_.size() && keys_[run.end] <= middle + 1) ++run.end;
  }
  ++cell_;
  return window_;
}

std::vector<std::uint32_t> points_near(const SurfaceCells& cells,
                                       std::span<const Eigen::Vector3d> points,
                                       const Eigen::Vector3d& place_m, double reach_m) {
  std::vector<std::uint32_t> near;
  const Eigen::Vector3d offset = place_m - cells.origin_m;
  const auto index = [&](double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate / cells.cell_m));
  };
  for (std::int64_t z = index(offset.z() - reach_m); z <= index(offset.z() + reach_m); ++z) {
    for (std::int64_t y = index(offset.y() - reach_m); y <= index(offset.y() + reach_m); ++y) {
      const std::uint64_t low = pack(index(offset.x() - reach_m), y, z);
      const std::uint64_t high = pack(index(offset.x() + reach_m), y, z);
      auto cell = std::lower_bound(cells.keys.begin(), cells.keys.end(), low);
      for (; cell != cells.keys.end() && *cell <= high; ++cell) {
        const auto at = static_cast<std::size_t>(cell - cells.keys.begin());
        for (std::uint32_t k = cells.first[at]; k < cells.first[at + 1]; ++k)
          if ((points[cells.order[k]] - place_m).squaredNorm() <= reach_m * reach_m)
            near.push_back(cells.order[k]);
      }
    }
  }
  return near;
}

}  // namespace alea
