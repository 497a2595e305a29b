#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace alea {

/// Points sorted into cubes. Within a cube they stand in the order of their coordinates, so that
/// sums over a cube have the same bits for any order of the input.
struct SurfaceCells {
  double cell_m = 0;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< a corner of the cell 0, 0, 0
  std::vector<std::uint64_t> keys;                     ///< of the occupied cells, ascending
  std::vector<std::uint32_t> first;                    ///< of each cell in `order`, and the end
  std::vector<std::uint32_t> order;                    ///< indices of the points

  std::size_t size() const { return keys.size(); }
};

/// Points further than a million cells from the origin are left out.
SurfaceCells surface_cells(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& origin_m,
                           double cell_m);

/// A range of occupied cells, [begin, end).
struct CellRun {
  std::size_t begin, end;
};

/// The occupied cells among the 27 about a cell: nine runs along x.
using CellWindow = std::array<CellRun, 9>;

/// Walks the windows of consecutive cells; each step costs a few comparisons, because the runs only
/// ever move on.
class WindowWalk {
 public:
  WindowWalk(const std::vector<std::uint64_t>& keys, std::size_t start);
  CellWindow next();

 private:
  const std::vector<std::uint64_t>& keys_;
  std::size_t cell_;
  CellWindow window_;
};

/// Indices of the points within `reach_m` of a place (same frame as the points), cell by cell.
std::vector<std::uint32_t> points_near(const SurfaceCells& cells,
                                       std::span<const Eigen::Vector3d> points,
                                       const Eigen::Vector3d& place_m, double reach_m);

}  // namespace alea
