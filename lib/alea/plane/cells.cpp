#include <algorithm>
#include <cmath>
#include <utility>

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

struct Labels {
  PointLabels points;
  std::vector<GrownPlane> planes;  ///< from the anchor
  Eigen::Vector3d anchor;
  double cell;
};

// Takes out the planes that keep less than half of their leaves' points because others are nearer:
// bevels of edges. Says whether there were any.
bool remove_bevels(GrownPlanes& grown, const std::vector<std::int32_t>& plane_of_point) {
  std::vector<double> kept(grown.planes.size(), 0);
  for (const std::int32_t p : plane_of_point)
    if (p >= 0) kept[static_cast<std::size_t>(p)] += 1;
  bool any = false;
  for (std::int32_t& p : grown.plane_of_leaf) {
    if (p < 0) continue;
    const auto k = static_cast<std::size_t>(p);
    if (2 * kept[k] >= grown.planes[k].moments.count) continue;
    p = -1;
    any = true;
  }
  return any;
}

Labels label(const std::vector<Eigen::Vector3d>& positions, const PlaneDetectionOptions& options) {
  const double tolerance = options.tolerance_m;
  const bool automatic = options.cell_m <= 0;
  const double cell = automatic ? coarse_cell * tolerance : options.cell_m;
  CellGrid grid = make_cell_grid(positions, cell, automatic ? mean_points : 0);
  const CellTree tree = make_cell_tree(grid, {tolerance, levels_between(grid.cell, tolerance)});
  const LeafAdjacency adjacency = leaf_adjacency(grid, tree);
  const double least_points = static_cast<double>(options.min_points) / 2;
  GrownPlanes grown = grow_planes(tree, adjacency, {tolerance, least_points});
  Labels out{assign_points(grid, tree, adjacency, grown, tolerance, positions.size()),
             {},
             grid.anchor,
             grid.cell};
  if (remove_bevels(grown, out.points.plane))
    out.points = assign_points(grid, tree, adjacency, grown, tolerance, positions.size());
  out.planes = std::move(grown.planes);
  return out;
}

// The number that a plane found among the rest gets: of the plane that it continues, else its own.
std::int32_t adopt(const GrownPlane& plane, std::size_t before, double tolerance, Labels& labels) {
  for (std::size_t p = 0; p < before; ++p)
    if (labels.planes[p].box.exteriorDistance(plane.box.center()) <=
            labels.cell + plane.box.diagonal().norm() / 2 &&
        coplanar(labels.planes[p], plane, tolerance))
      return static_cast<std::int32_t>(p);
  labels.planes.push_back(plane);
  return static_cast<std::int32_t>(labels.planes.size()) - 1;
}

// A facet seen at a grazing angle shares every cell that holds several of its rows with its
// neighbours; once those are gone, the same cells hold it alone.
void label_the_rest(const std::vector<Eigen::Vector3d>& positions,
                    const PlaneDetectionOptions& options, Labels& labels) {
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    if (labels.points.plane[i] < 0) rest.push_back(i);
  if (rest.size() < options.min_points) return;
  std::vector<Eigen::Vector3d> left;
  left.reserve(rest.size());
  for (const std::uint32_t i : rest) left.push_back(positions[i]);
  Labels more = label(left, options);
  const Eigen::Vector3d shift = more.anchor - labels.anchor;
  const std::size_t before = labels.planes.size();
  std::vector<std::int32_t> number;
  for (GrownPlane& plane : more.planes) {
    plane.moments.mean += shift;
    plane.box.translate(shift);
    number.push_back(adopt(plane, before, options.tolerance_m, labels));
  }
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (more.points.plane[k] < 0) continue;
    labels.points.plane[rest[k]] = number[static_cast<std::size_t>(more.points.plane[k])];
    labels.points.contested[rest[k]] = more.points.contested[k];
  }
}

}  // namespace

std::vector<PlaneRegion> detect_by_cells(const Cloud& cloud, const PlaneDetectionOptions& options) {
  Labels labels = label(cloud.positions, options);
  label_the_rest(cloud.positions, options, labels);
  return regions_from_labels(cloud, labels.points, labels.planes.size(), options.min_points);
}

}  // namespace alea
