#include <algorithm>
#include <cmath>

#include "alea/plane/cell_assignment.hpp"
#include "alea/plane/cell_growth.hpp"
#include "alea/plane/cell_tree.hpp"
#include "alea/plane/detectors.hpp"
#include "alea/plane/region_fit.hpp"

namespace alea {
namespace {

// In tolerances: the largest cell, and the smallest that still tells an edge from noise.
constexpr double coarse_cell = 64;
constexpr double fine_cell = 4;
// Points that a largest cell should hold on average.
constexpr double mean_points = 24;

int levels_between(double cell, double tolerance) {
  return std::clamp(static_cast<int>(std::floor(std::log2(cell / (fine_cell * tolerance)) + 1e-9)),
                    0, 8);
}

}  // namespace

std::vector<PlaneRegion> detect_by_cells(const Cloud& cloud, const PlaneDetectionOptions& options) {
  const double tolerance = options.tolerance_m;
  const double cell = options.cell_m > 0 ? options.cell_m : coarse_cell * tolerance;
  CellGrid grid = make_cell_grid(cloud.positions, cell, options.cell_m > 0 ? 0 : mean_points);
  const CellTree tree = make_cell_tree(grid, {tolerance, levels_between(grid.cell, tolerance)});
  const LeafAdjacency adjacency = leaf_adjacency(grid, tree);
  const GrownPlanes grown =
      grow_planes(tree, adjacency, {tolerance, static_cast<double>(options.min_points) / 2});
  const std::vector<std::int32_t> plane_of_point =
      assign_points(grid, tree, adjacency, grown, tolerance, cloud.size());
  return regions_from_labels(cloud, plane_of_point, grown.planes.size(), options.min_points);
}

}  // namespace alea
