#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "alea/cloud/sampling.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr double fixed_point = 4294967296.0;  // 2^32: sums of up to 2^31 terms fit
constexpr std::uint64_t empty_key = std::numeric_limits<std::uint64_t>::max();

/// The grid: keys order the cells by z, then y, then x.
struct Grid {
  Eigen::Vector3d low_m;
  double cell_m;

  struct Place {
    std::uint64_t key;
    std::array<std::int64_t, 3> within;  ///< from the cell's corner, in cells, fixed point
  };
  Place place(const Eigen::Vector3d& p) const {
    Place found{};
    for (int i = 2; i >= 0; --i) {
      const double steps = (p[i] - low_m[i]) / cell_m;
      const auto cell = static_cast<std::int64_t>(steps);  // never negative
      found.key = found.key << 21 | static_cast<std::uint64_t>(cell);
      found.within[static_cast<std::size_t>(i)] =
          static_cast<std::int64_t>((steps - static_cast<double>(cell)) * fixed_point);
    }
    return found;
  }
  Eigen::Vector3d corner(std::uint64_t key) const {
    constexpr std::uint64_t mask = (std::uint64_t{1} << 21) - 1;
    const Eigen::Vector3d cells(static_cast<double>(key & mask),
                                static_cast<double>(key >> 21 & mask),
                                static_cast<double>(key >> 42));
    return low_m + cell_m * cells;
  }
};

/// Integer sums of one cell: they add in any order to the same bits. The attributes are intensity,
/// normal (3) and colour (3).
struct Cell {
  std::uint64_t key = empty_key;
  std::array<std::int64_t, 3> within{};
  std::int64_t count = 0;
};
using Attributes = std::array<std::int64_t, 7>;

/// The cells that one share of the points meets: open addressing, cells in order of appearance.
class CellTable {
 public:
  explicit CellTable(std::size_t expected)
      : slots_(std::bit_ceil(std::max<std::size_t>(1024, expected)), 0) {}

  std::uint32_t find_or_add(std::uint64_t key) {
    if (!cells.empty() && cells[last_].key == key) return last_;
    if (2 * cells.size() >= slots_.size()) grow();
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != 0 && cells[slots_[slot] - 1].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == 0) {
      cells.push_back({key, {}, 0});
      slots_[slot] = static_cast<std::uint32_t>(cells.size());
    }
    last_ = slots_[slot] - 1;
    return last_;
  }

  std::vector<Cell> cells;
  std::vector<Attributes> attributes;  ///< empty, or one for each cell

 private:
  static std::size_t hash(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15ull;
    return key ^ key >> 32;
  }
  void grow() {
    std::vector<std::uint32_t> larger(2 * slots_.size(), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::size_t slot = hash(cells[i].key) & (larger.size() - 1);
      while (larger[slot] != 0) slot = (slot + 1) & (larger.size() - 1);
      larger[slot] = static_cast<std::uint32_t>(i + 1);
    }
    slots_ = std::move(larger);
  }

  std::vector<std::uint32_t> slots_;
  std::uint32_t last_ = 0;
};

std::pair<Eigen::Vector3d, Eigen::Vector3d> box_of(const std::vector<Eigen::Vector3d>& points) {
  constexpr std::size_t share = 1 << 16;
  const std::pair<Eigen::Vector3d, Eigen::Vector3d> first{points[0], points[0]};
  std::vector boxes((points.size() + share - 1) / share, first);
  parallel_chunks(points.size(), share, [&](std::size_t begin, std::size_t end) {
    auto [low, high] = first;
    for (std::size_t i = begin; i < end; ++i) {
      low = low.cwiseMin(points[i]);
      high = high.cwiseMax(points[i]);
    }
    boxes[begin / share] = {low, high};
  });
  auto [low, high] = first;
  for (const auto& box : boxes) {
    low = low.cwiseMin(box.first);
    high = high.cwiseMax(box.second);
  }
  return {low, high};
}

Grid grid_of(const Cloud& cloud, double cell_m) {
  if (!(cell_m > 0) || !std::isfinite(cell_m))
    throw usage_error("grid average: the cell size must be positive (m)");
  const auto [low, high] = box_of(cloud.positions);
  if (!((high - low).maxCoeff() / cell_m < (1 << 21)))
    throw usage_error(fmt::format(
        "grid average: {} m is too small a cell for a cloud of {} m; at most 2^21 cells an axis",
        cell_m, (high - low).maxCoeff()));
  return {low, cell_m};
}

/// Largest power of two that keeps the sum of all intensities within 62 bits.
double intensity_scale(const Cloud& cloud) {
  double bound = 0;
  for (const float i : cloud.intensity)
    if (std::isfinite(i)) bound = std::max(bound, std::abs(static_cast<double>(i)));
  int exponent = 0;
  std::frexp(bound * static_cast<double>(cloud.size()), &exponent);
  return std::ldexp(1.0, 62 - exponent);
}

void add_attributes(const Cloud& cloud, std::size_t i, double scale, Attributes& sums) {
  if (cloud.has_intensity() && std::isfinite(cloud.intensity[i]))
    sums[0] += static_cast<std::int64_t>(static_cast<double>(cloud.intensity[i]) * scale);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!cloud.normals.empty())
      sums[1 + k] += static_cast<std::int64_t>(
          static_cast<double>(cloud.normals[i][static_cast<Eigen::Index>(k)]) * fixed_point / 2);
    if (!cloud.colours.empty()) sums[4 + k] += cloud.colours[i][k];
  }
}

bool has_attributes(const Cloud& cloud) {
  return cloud.has_intensity() || !cloud.normals.empty() || !cloud.colours.empty();
}

/// The cells of the points [begin, end).
CellTable table_of(const Cloud& cloud, const Grid& grid, double scale, std::size_t begin,
                   std::size_t end) {
  CellTable table((end - begin) / 2);
  const bool attributes = has_attributes(cloud);
  for (std::size_t i = begin; i < end; ++i) {
    const Grid::Place place = grid.place(cloud.positions[i]);
    const std::uint32_t at = table.find_or_add(place.key);
    Cell& cell = table.cells[at];
    for (std::size_t k = 0; k < 3; ++k) cell.within[k] += place.within[k];
    ++cell.count;
    if (!attributes) continue;
    table.attributes.resize(table.cells.size());
    add_attributes(cloud, i, scale, table.attributes[at]);
  }
  return table;
}

/// One cell as a share of the points saw it.
struct Part {
  std::uint64_t key;
  std::uint32_t table;
  std::uint32_t cell;
};

std::vector<Part> sorted_parts(const std::vector<CellTable>& tables) {
  std::vector<Part> parts;
  std::size_t count = 0;
  for (const CellTable& table : tables) count += table.cells.size();
  parts.reserve(count);
  for (std::uint32_t t = 0; t < tables.size(); ++t)
    for (std::uint32_t c = 0; c < tables[t].cells.size(); ++c)
      parts.push_back({tables[t].cells[c].key, t, c});
  tbb::parallel_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.key < b.key; });
  return parts;
}

/// Where each cell's parts begin among the sorted ones, and the end of all.
std::vector<std::size_t> begins_of_cells(const std::vector<Part>& parts) {
  std::vector<std::size_t> begins;
  begins.reserve(parts.size() + 1);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (i == 0 || parts[i].key != parts[i - 1].key) begins.push_back(i);
  begins.push_back(parts.size());
  return begins;
}

void size_like(const Cloud& cloud, std::size_t count, Cloud& out) {
  out.positions.resize(count);
  if (cloud.has_intensity()) out.intensity.resize(count);
  if (!cloud.normals.empty()) out.normals.resize(count);
  if (!cloud.colours.empty()) out.colours.resize(count);
}

/// The mean of a cell as point `at` of the sample.
void put_mean(const Grid& grid, const Cell& cell, const Attributes& sums, double scale,
              std::size_t at, Cloud& out) {
  const auto count = static_cast<double>(cell.count);
  const double unit = grid.cell_m / (fixed_point * count);
  out.positions[at] =
      grid.corner(cell.key) + unit * Eigen::Vector3d(static_cast<double>(cell.within[0]),
                                                     static_cast<double>(cell.within[1]),
                                                     static_cast<double>(cell.within[2]));
  if (out.has_intensity())
    out.intensity[at] = static_cast<float>(static_cast<double>(sums[0]) / scale / count);
  if (!out.normals.empty()) {
    const Eigen::Vector3d sum(static_cast<double>(sums[1]), static_cast<double>(sums[2]),
                              static_cast<double>(sums[3]));
    out.normals[at] = sum.normalized().cast<float>();
  }
  if (!out.colours.empty())
    for (std::size_t k = 0; k < 3; ++k)
      out.colours[at][k] = static_cast<std::uint16_t>((sums[4 + k] + cell.count / 2) / cell.count);
}

}  // namespace

Cloud grid_average(const Cloud& cloud, double cell_m) {
  Cloud out;
  out.scanner_position = cloud.scanner_position;
  if (cloud.empty()) return out;
  const Grid grid = grid_of(cloud, cell_m);
  const double scale = cloud.has_intensity() ? intensity_scale(cloud) : 1;
  constexpr std::size_t share = 1 << 17;
  std::vector<CellTable> tables((cloud.size() + share - 1) / share, CellTable(0));
  parallel_chunks(cloud.size(), share, [&](std::size_t begin, std::size_t end) {
    tables[begin / share] = table_of(cloud, grid, scale, begin, end);
  });
  const std::vector<Part> parts = sorted_parts(tables);
  const std::vector<std::size_t> begins = begins_of_cells(parts);
  size_like(cloud, begins.size() - 1, out);
  parallel_chunks(begins.size() - 1, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at) {
      Cell cell{parts[begins[at]].key, {}, 0};
      Attributes sums{};
      for (std::size_t i = begins[at]; i < begins[at + 1]; ++i) {
        const CellTable& table = tables[parts[i].table];
        const Cell& part = table.cells[parts[i].cell];
        for (std::size_t k = 0; k < 3; ++k) cell.within[k] += part.within[k];
        cell.count += part.count;
        if (table.attributes.empty()) continue;
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += table.attributes[parts[i].cell][k];
      }
      put_mean(grid, cell, sums, scale, at, out);
    }
  });
  return out;
}

}  // namespace alea
