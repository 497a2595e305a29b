#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "alea/core/parallel.hpp"
#include "alea/evaluate/check_planes.hpp"

namespace alea {
namespace {

// A raster of more cells than this (a plane of kilometres) gets wider ones.
constexpr double most_grid_cells = 1 << 24;
constexpr std::uint32_t outside = 0xffffffffu;
// Below this the two sides of a board are as good as one plane.
constexpr double thinnest_wall_m = 0.01;

/// The box of a master region in its plane, divided into square cells; in the master frame.
struct Raster {
  Eigen::Matrix<double, 2, 3> cells_from_xyz;  ///< columns and rows from the box's corner
  Eigen::Vector2d origin;
  std::uint32_t columns = 0, rows = 0;

  /// Cell of a point of a cloud in whose frame `from_xyz` and `from_origin` are, or outside.
  std::uint32_t cell_of(const Eigen::Vector2d& at) const {
    if (!(at.x() >= 0 && at.y() >= 0 && at.x() < columns && at.y() < rows)) return outside;
    return static_cast<std::uint32_t>(at.y()) * columns + static_cast<std::uint32_t>(at.x());
  }
};

Raster raster_of(const Cloud& master, const PlaneRegion& region, double cell_m) {
  const Eigen::Matrix<double, 2, 3> along = tangent_basis(region.plane.normal).transpose();
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const std::uint32_t i : region.indices) {
    const Eigen::Vector2d at = along * (master.positions[i] - region.centroid_m);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector2d size = high - low;
  const double cell = std::max(
      cell_m, std::sqrt(size.prod() / most_grid_cells) + size.maxCoeff() / most_grid_cells);
  Raster out;
  out.cells_from_xyz = along / cell;
  // Cells keep their place relative to the centroid, whichever point is outermost.
  const Eigen::Array2d first = (low / cell).array().floor();
  out.origin = first.matrix() + out.cells_from_xyz * region.centroid_m;
  const Eigen::Array2d count = (high / cell).array().floor() - first + 1;
  out.columns = static_cast<std::uint32_t>(count.x());
  out.rows = static_cast<std::uint32_t>(count.y());
  return out;
}

/// The cell of each of a region's points.
std::vector<std::uint32_t> cells_of(const Raster& raster, const Cloud& cloud,
                                    const PlaneRegion& region,
                                    const RigidTransform& master_from_cloud) {
  const Eigen::Matrix<double, 2, 3> turned = raster.cells_from_xyz * master_from_cloud.rotation;
  const Eigen::Vector2d shift =
      raster.cells_from_xyz * master_from_cloud.translation - raster.origin;
  std::vector<std::uint32_t> out;
  out.reserve(region.indices.size());
  for (const std::uint32_t i : region.indices)
    out.push_back(raster.cell_of(turned * cloud.positions[i] + shift));
  return out;
}

std::vector<std::uint32_t> inside(const PlaneRegion& region,
                                  const std::vector<std::uint32_t>& cell_of_point,
                                  const std::vector<char>& occupied) {
  std::vector<std::uint32_t> kept;
  for (std::size_t k = 0; k < region.indices.size(); ++k)
    if (cell_of_point[k] != outside && occupied[cell_of_point[k]])
      kept.push_back(region.indices[k]);
  return kept;
}

struct Candidate {
  std::size_t master = 0, slave = 0;
  std::vector<std::uint32_t> indices_master, indices_slave;
  std::size_t common() const { return std::min(indices_master.size(), indices_slave.size()); }
};

bool roughly_coplanar(const PlaneRegion& master, const PlaneRegion& slave,
                      const RigidTransform& master_from_slave, const CommonPlaneOptions& options) {
  const Eigen::Vector3d normal = master_from_slave.rotation * slave.plane.normal;
  if (std::abs(normal.dot(master.plane.normal)) < std::cos(options.max_angle_rad)) return false;
  const Eigen::Vector3d centroid = master_from_slave * slave.centroid_m;
  const double reach = (centroid - master.centroid_m).norm() * std::sin(options.max_angle_rad);
  return std::abs(master.plane.signed_distance(centroid)) < options.max_offset_m + reach;
}

/// How far apart the two planes may lie. A wall seen from both its sides is two planes, its
/// thickness apart: normals point to the scanners, where those are known.
double most_offset_m(const Cloud& master, const CommonPlane& pair, const Cloud& slave,
                     const RigidTransform& master_from_slave, const CommonPlaneOptions& options) {
  if (!master.scanner_position || !slave.scanner_position) return options.max_offset_m;
  const Eigen::Vector3d slave_scanner = master_from_slave * *slave.scanner_position;
  const Plane& plane = pair.fit_master.plane;
  const bool same_side =
      plane.signed_distance(*master.scanner_position) * plane.signed_distance(slave_scanner) > 0;
  return same_side ? options.max_offset_m : std::min(options.max_offset_m, thinnest_wall_m);
}

/// A master region held ready for all the slave regions that may share its plane.
struct RasteredRegion {
  Raster raster;
  std::vector<std::uint32_t> cell_of_point;
  std::vector<char> occupied;
};

void occupy(const std::vector<std::uint32_t>& cell_of_point, std::vector<char>& occupied) {
  for (const std::uint32_t cell : cell_of_point)
    if (cell != outside) occupied[cell] = 1;
}

RasteredRegion rastered(const Cloud& master, const PlaneRegion& region, double cell_m) {
  RasteredRegion out{raster_of(master, region, cell_m), {}, {}};
  out.cell_of_point = cells_of(out.raster, master, region, {});
  out.occupied.resize(std::size_t{out.raster.columns} * out.raster.rows, 0);
  occupy(out.cell_of_point, out.occupied);
  return out;
}

std::optional<Candidate> common_area(const RasteredRegion& area, const PlaneRegion& master_region,
                                     const Cloud& slave, const PlaneRegion& slave_region,
                                     const RigidTransform& master_from_slave,
                                     std::size_t min_points) {
  Candidate out;
  const std::vector<std::uint32_t> slave_cells =
      cells_of(area.raster, slave, slave_region, master_from_slave);
  out.indices_slave = inside(slave_region, slave_cells, area.occupied);
  if (out.indices_slave.size() < min_points) return std::nullopt;
  std::vector<char> slave_occupied(area.occupied.size(), 0);
  occupy(slave_cells, slave_occupied);
  out.indices_master = inside(master_region, area.cell_of_point, slave_occupied);
  return out.common() >= min_points ? std::optional(std::move(out)) : std::nullopt;
}

PlaneFit fit_subset(const Cloud& cloud, const std::vector<std::uint32_t>& indices) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(indices.size());
  for (const std::uint32_t i : indices) points.push_back(cloud.positions[i]);
  return fit_plane(points,
                   {.method = FitMethod::orthogonal, .scanner_position = cloud.scanner_position});
}

bool agree_over_area(const CommonPlane& pair, const RigidTransform& master_from_slave,
                     double max_offset_m) {
  const Eigen::Vector3d centroid = master_from_slave * pair.fit_slave.centroid_m;
  return std::abs(pair.fit_master.plane.signed_distance(centroid)) < max_offset_m;
}

/// Every pair of regions that may be one plane, with the points of each in the area of both.
std::vector<Candidate> shared_areas(const Cloud& master,
                                    std::span<const PlaneRegion> master_regions, const Cloud& slave,
                                    std::span<const PlaneRegion> slave_regions,
                                    const RigidTransform& master_from_slave,
                                    const CommonPlaneOptions& options) {
  std::vector<Candidate> candidates;
  for (std::size_t m = 0; m < master_regions.size(); ++m) {
    std::optional<RasteredRegion> area;
    for (std::size_t s = 0; s < slave_regions.size(); ++s) {
      if (!roughly_coplanar(master_regions[m], slave_regions[s], master_from_slave, options))
        continue;
      if (!area) area = rastered(master, master_regions[m], options.raster_m);
      auto found = common_area(*area, master_regions[m], slave, slave_regions[s], master_from_slave,
                               options.min_points);
      if (!found) continue;
      found->master = m;
      found->slave = s;
      candidates.push_back(std::move(*found));
    }
  }
  return candidates;
}

}  // namespace

std::vector<CommonPlane> find_common_planes(const Cloud& master,
                                            std::span<const PlaneRegion> master_regions,
                                            const Cloud& slave,
                                            std::span<const PlaneRegion> slave_regions,
                                            const RigidTransform& master_from_slave,
                                            const CommonPlaneOptions& options) {
  std::vector<Candidate> candidates =
      shared_areas(master, master_regions, slave, slave_regions, master_from_slave, options);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.common() > b.common(); });

  std::vector<bool> master_taken(master_regions.size()), slave_taken(slave_regions.size());
  std::vector<CommonPlane> pairs;
  for (Candidate& candidate : candidates) {
    if (master_taken[candidate.master] || slave_taken[candidate.slave]) continue;
    CommonPlane pair;
    parallel_pair([&] { pair.fit_master = fit_subset(master, candidate.indices_master); },
                  [&] { pair.fit_slave = fit_subset(slave, candidate.indices_slave); });
    if (!agree_over_area(pair, master_from_slave,
                         most_offset_m(master, pair, slave, master_from_slave, options)))
      continue;
    master_taken[candidate.master] = slave_taken[candidate.slave] = true;
    pair.id = static_cast<int>(pairs.size()) + 1;
    pair.indices_master = std::move(candidate.indices_master);
    pair.indices_slave = std::move(candidate.indices_slave);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace alea
