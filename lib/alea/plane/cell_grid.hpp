#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace alea {

/// A point in its cell: whole quanta from the cell's centre, and its index in the cloud.
struct CellPoint {
  std::array<std::int32_t, 3> local;
  std::uint32_t index;
};

struct Cell {
  std::array<std::int32_t, 3> place;  ///< column, row, layer of the grid
  std::uint32_t begin;                ///< of its points in CellGrid::points
  std::uint32_t end;
};

/// Finds a cell by its place: open addressing over packed places.
class CellTable {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr int place_bits = 21;
  static std::uint64_t pack(std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << place_bits |
           static_cast<std::uint64_t>(z) << (2 * place_bits);
  }

  CellTable();
  /// The value of `key`, or `fresh` after storing it for a key not met before.
  std::uint32_t find_or_insert(std::uint64_t key, std::uint32_t fresh);
  std::uint32_t find(std::uint64_t key) const;
  std::size_t size() const { return size_; }
  void assign(std::uint64_t key, std::uint32_t value);

 private:
  std::size_t slot_of(std::uint64_t key) const;
  void grow();
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> values_;
  std::size_t size_ = 0;
  int shift_ = 0;
};

/// The points of a cloud sorted by cubic cells. Cells are in ascending order of their packed place;
/// the order of points within a cell carries no meaning.
struct CellGrid {
  /// A cell is 2^quantum_bits quanta wide: squares summed over 2^27 points still fit 64 bits.
  static constexpr int quantum_bits = 18;

  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< corner of the cell at place 0, 0, 0
  double cell = 0;                                   ///< edge of a cell
  std::vector<CellPoint> points;
  std::vector<Cell> cells;
  CellTable table;

  /// The cell at a place, or CellTable::none.
  std::uint32_t cell_at(const std::array<std::int32_t, 3>& place) const;
  /// The cell at one of the 27 places around `place` (step 13 is the place itself), or none.
  std::uint32_t cell_beside(const std::array<std::int32_t, 3>& place, int step) const {
    return cell_at({place[0] + step % 3 - 1, place[1] + step / 3 % 3 - 1, place[2] + step / 9 - 1});
  }

  double quantum() const { return cell / (1 << quantum_bits); }
  /// Centre of a cell, from the anchor.
  Eigen::Vector3d centre(const Cell& c) const {
    return Eigen::Vector3d(c.place[0] + 0.5, c.place[1] + 0.5, c.place[2] + 0.5) * cell;
  }
  Eigen::Vector3d position(const Cell& c, const CellPoint& p) const {
    return centre(c) + Eigen::Vector3d(p.local[0], p.local[1], p.local[2]) * quantum();
  }
};

/// Sorts the finite points into cells of edge `cell`, doubled until a cell holds `mean_points` on
/// average. The grid hangs on the cloud's own least coordinates, so that it moves with the cloud;
/// where a stray point makes the cloud wider than 2^21 cells, on the median less 2^20 cells, and
/// points outside the grid are left out.
CellGrid make_cell_grid(const std::vector<Eigen::Vector3d>& positions, double cell,
                        double mean_points);

}  // namespace alea
