#include "alea/plane/region_refit.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/parallel.hpp"
#include "alea/plane/cell_grid.hpp"
#include "alea/plane/region_fit.hpp"

namespace alea {
namespace {

using Numbers = std::vector<std::int32_t>;

void sort_unique(Numbers& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// The planes that have members in each cell, ascending.
std::vector<Numbers> planes_of_cells(const CellGrid& grid, const Numbers& plane_of_point) {
  std::vector<Numbers> planes(grid.cells.size());
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    for (std::uint32_t k = grid.cells[c].begin; k < grid.cells[c].end; ++k) {
      const std::int32_t plane = plane_of_point[grid.points[k].index];
      if (plane >= 0 && (planes[c].empty() || planes[c].back() != plane))
        planes[c].push_back(plane);
    }
    sort_unique(planes[c]);
  }
  return planes;
}

Numbers planes_around(const CellGrid& grid, const std::vector<Numbers>& planes, const Cell& cell) {
  Numbers out;
  for (int step = 0; step < 27; ++step) {
    const std::uint32_t other = grid.cell_beside(cell.place, step);
    if (other != CellTable::none) out.insert(out.end(), planes[other].begin(), planes[other].end());
  }
  sort_unique(out);
  return out;
}

// Fitted planes, from the grid's anchor.
struct FittedPlanes {
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> offsets;
};

FittedPlanes fit_members(const Cloud& cloud, const Numbers& plane_of_point, std::size_t planes,
                         const Eigen::Vector3d& anchor) {
  std::vector<std::vector<std::uint32_t>> members(planes);
  for (std::uint32_t i = 0; i < plane_of_point.size(); ++i)
    if (plane_of_point[i] >= 0) members[static_cast<std::size_t>(plane_of_point[i])].push_back(i);
  FittedPlanes out;
  for (std::vector<std::uint32_t>& indices : members) {
    PlaneRegion region;
    if (indices.size() >= 3) region = fit_region(cloud, std::move(indices));
    out.normals.push_back(region.plane.normal);
    out.offsets.push_back(region.plane.normal.dot(region.centroid_m - anchor));
  }
  return out;
}

}  // namespace

std::vector<PlaneRegion> refitted_regions(const Cloud& cloud, Numbers plane_of_point,
                                          std::size_t planes, const PlaneDetectionOptions& options,
                                          double reach) {
  if (planes == 0) return {};
  const double edge = reach > 0 ? reach : 4 * options.tolerance_m;
  const CellGrid grid = make_cell_grid(cloud.positions, edge, 0);
  const std::vector<Numbers> in_cell = planes_of_cells(grid, plane_of_point);
  const FittedPlanes fitted = fit_members(cloud, plane_of_point, planes, grid.anchor);
  PointLabels labels(cloud.size());
  const auto label = [&](std::uint32_t point, const Numbers& candidates) {
    const Eigen::Vector3d p = cloud.positions[point] - grid.anchor;
    double least = options.tolerance_m;
    for (const std::int32_t plane : candidates) {
      const auto k = static_cast<std::size_t>(plane);
      const double distance = std::abs(fitted.normals[k].dot(p) - fitted.offsets[k]);
      if (distance > options.tolerance_m) continue;
      std::int32_t& best = labels.plane[point];
      labels.contested[point] |= best >= 0;
      if (distance > least || (distance == least && best >= 0)) continue;
      least = distance;
      best = plane;
    }
  };
  parallel_chunks(grid.cells.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Numbers candidates = planes_around(grid, in_cell, grid.cells[c]);
      for (std::uint32_t k = grid.cells[c].begin; k < grid.cells[c].end; ++k)
        label(grid.points[k].index, candidates);
    }
  });
  return regions_from_labels(cloud, labels, planes, options.min_points);
}

}  // namespace alea
