#include "alea/plane/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace alea {
namespace {

constexpr std::uint64_t free_slot = ~std::uint64_t{0};
constexpr std::int64_t places = std::int64_t{1} << CellTable::place_bits;

struct Extent {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
};

Extent finite_extent(const std::vector<Eigen::Vector3d>& positions) {
  Extent extent;
  for (const Eigen::Vector3d& p : positions) {
    if (!p.allFinite()) continue;
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  return extent;
}

// Median of each coordinate: costs a selection, so only where the extent is unusable.
Eigen::Vector3d finite_median(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : positions)
      if (p.allFinite()) values.push_back(p[axis]);
    if (values.empty()) continue;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[axis] = *middle;
  }
  return median;
}

// Maps a coordinate to whole quanta from the anchor.
struct Quantiser {
  Eigen::Vector3d anchor;
  double per_quantum;

  bool operator()(const Eigen::Vector3d& p, std::array<std::int64_t, 3>& quanta) const {
    constexpr double end = static_cast<double>(places << CellGrid::quantum_bits);
    for (int axis = 0; axis < 3; ++axis) {
      const double scaled = (p[axis] - anchor[axis]) * per_quantum;
      if (!(scaled >= 0 && scaled < end)) return false;  // outside, or not a number
      quanta[axis] = static_cast<std::int64_t>(scaled);
    }
    return true;
  }
};

std::uint64_t key_of(const std::array<std::int64_t, 3>& quanta) {
  constexpr int bits = CellGrid::quantum_bits;
  return CellTable::pack(quanta[0] >> bits, quanta[1] >> bits, quanta[2] >> bits);
}

// Counts of points for each cell in the order met, and each point's cell.
struct Binning {
  CellTable table;
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> cell_of_point;
  std::size_t binned = 0;
};

Binning bin(const std::vector<Eigen::Vector3d>& positions, const Quantiser& quantise) {
  Binning out;
  out.cell_of_point.resize(positions.size());
  std::uint64_t last_key = free_slot;
  std::uint32_t last_cell = 0;
  std::array<std::int64_t, 3> quanta{};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!quantise(positions[i], quanta)) {
      out.cell_of_point[i] = CellTable::none;
      continue;
    }
    const std::uint64_t key = key_of(quanta);
    if (key != last_key) {
      last_key = key;
      last_cell = out.table.find_or_insert(key, static_cast<std::uint32_t>(out.keys.size()));
      if (last_cell == out.keys.size()) {
        out.keys.push_back(key);
        out.counts.push_back(0);
      }
    }
    out.cell_of_point[i] = last_cell;
    ++out.counts[last_cell];
    ++out.binned;
  }
  return out;
}

// Cells in ascending order of key, each with its range; start[c] is where cell c of the binning
// begins.
std::vector<std::uint32_t> lay_out(const Binning& binning, CellGrid& grid) {
  std::vector<std::uint32_t> order(binning.keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return binning.keys[a] < binning.keys[b]; });
  std::vector<std::uint32_t> start(order.size());
  std::uint32_t next = 0;
  constexpr std::uint64_t mask = static_cast<std::uint64_t>(places - 1);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const std::uint32_t c = order[rank];
    const std::uint64_t key = binning.keys[c];
    start[c] = next;
    Cell cell{{static_cast<std::int32_t>(key & mask),
               static_cast<std::int32_t>(key >> CellTable::place_bits & mask),
               static_cast<std::int32_t>(key >> (2 * CellTable::place_bits))},
              next,
              next + binning.counts[c]};
    next = cell.end;
    grid.cells.push_back(cell);
    grid.table.assign(key, static_cast<std::uint32_t>(rank));
  }
  return start;
}

void scatter(const std::vector<Eigen::Vector3d>& positions, const Quantiser& quantise,
             const Binning& binning, std::vector<std::uint32_t> next, CellGrid& grid) {
  constexpr std::int64_t width = std::int64_t{1} << CellGrid::quantum_bits;
  grid.points.resize(binning.binned);
  std::array<std::int64_t, 3> quanta{};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::uint32_t cell = binning.cell_of_point[i];
    if (cell == CellTable::none) continue;
    quantise(positions[i], quanta);
    CellPoint& point = grid.points[next[cell]++];
    for (int axis = 0; axis < 3; ++axis)
      point.local[axis] = static_cast<std::int32_t>((quanta[axis] & (width - 1)) - width / 2);
    point.index = static_cast<std::uint32_t>(i);
  }
}

}  // namespace

CellTable::CellTable() : keys_(1024, free_slot), values_(1024), shift_(64 - 10) {}

std::size_t CellTable::slot_of(std::uint64_t key) const {
  std::size_t slot = key * 0x9e3779b97f4a7c15u >> shift_;
  while (keys_[slot] != key && keys_[slot] != free_slot) slot = (slot + 1) & (keys_.size() - 1);
  return slot;
}

std::uint32_t CellTable::find(std::uint64_t key) const {
  const std::size_t slot = slot_of(key);
  return keys_[slot] == key ? values_[slot] : none;
}

std::uint32_t CellTable::find_or_insert(std::uint64_t key, std::uint32_t fresh) {
  std::size_t slot = slot_of(key);
  if (keys_[slot] == key) return values_[slot];
  if (2 * (size_ + 1) > keys_.size()) {
    grow();
    slot = slot_of(key);
  }
  keys_[slot] = key;
  values_[slot] = fresh;
  ++size_;
  return fresh;
}

void CellTable::assign(std::uint64_t key, std::uint32_t value) {
  find_or_insert(key, value);
  values_[slot_of(key)] = value;
}

void CellTable::grow() {
  std::vector<std::uint64_t> old_keys(2 * keys_.size(), free_slot);
  std::vector<std::uint32_t> old_values(2 * values_.size());
  old_keys.swap(keys_);
  old_values.swap(values_);
  --shift_;
  for (std::size_t i = 0; i < old_keys.size(); ++i) {
    if (old_keys[i] == free_slot) continue;
    const std::size_t slot = slot_of(old_keys[i]);
    keys_[slot] = old_keys[i];
    values_[slot] = old_values[i];
  }
}

std::uint32_t CellGrid::cell_at(const std::array<std::int32_t, 3>& place) const {
  for (const std::int32_t p : place)
    if (p < 0 || p >= places) return CellTable::none;
  return table.find(CellTable::pack(place[0], place[1], place[2]));
}

CellGrid make_cell_grid(const std::vector<Eigen::Vector3d>& positions, double cell,
                        double mean_points) {
  CellGrid grid;
  const Extent extent = finite_extent(positions);
  grid.cell = cell;
  if (!extent.low.allFinite()) return grid;
  const double width = (extent.high - extent.low).maxCoeff();
  for (;; grid.cell *= 2) {
    const bool too_wide = !(width < static_cast<double>(places) * grid.cell);
    grid.anchor = extent.low;
    if (too_wide)
      grid.anchor = finite_median(positions) -
                    Eigen::Vector3d::Constant(static_cast<double>(places / 2) * grid.cell);
    const double per_quantum = (1 << CellGrid::quantum_bits) / grid.cell;
    const Quantiser quantise{grid.anchor, per_quantum};
    const Binning binning = bin(positions, quantise);
    const double mean = static_cast<double>(binning.binned) /
                        static_cast<double>(std::max<std::size_t>(1, binning.keys.size()));
    if (mean < mean_points && binning.keys.size() > 1) continue;
    scatter(positions, quantise, binning, lay_out(binning, grid), grid);
    return grid;
  }
}

}  // namespace alea
