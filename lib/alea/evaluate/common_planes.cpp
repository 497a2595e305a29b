#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "alea/evaluate/check_planes.hpp"

namespace alea {
namespace {

using Cell = std::pair<std::int32_t, std::int32_t>;

/// A raster in the plane of a master region, in the master frame.
struct Raster {
  Eigen::Vector3d origin_m;
  Eigen::Matrix<double, 3, 2> axes;
  double cell_m;

  Cell cell_of(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d uv = axes.transpose() * (p - origin_m) / cell_m;
    return {static_cast<std::int32_t>(std::floor(uv.x())),
            static_cast<std::int32_t>(std::floor(uv.y()))};
  }
};

std::vector<Cell> occupied(const Raster& raster, const Cloud& cloud, const PlaneRegion& region,
                           const RigidTransform& master_from_cloud) {
  std::vector<Cell> cells;
  cells.reserve(region.indices.size());
  for (const std::uint32_t i : region.indices)
    cells.push_back(raster.cell_of(master_from_cloud * cloud.positions[i]));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

std::vector<std::uint32_t> inside(const Raster& raster, const Cloud& cloud,
                                  const PlaneRegion& region,
                                  const RigidTransform& master_from_cloud,
                                  const std::vector<Cell>& cells) {
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t i : region.indices)
    if (std::binary_search(cells.begin(), cells.end(),
                           raster.cell_of(master_from_cloud * cloud.positions[i])))
      kept.push_back(i);
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

std::optional<Candidate> common_area(const Cloud& master, const PlaneRegion& master_region,
                                     const Cloud& slave, const PlaneRegion& slave_region,
                                     const RigidTransform& master_from_slave,
                                     const CommonPlaneOptions& options) {
  const Raster raster{master_region.centroid_m, tangent_basis(master_region.plane.normal),
                      options.raster_m};
  const std::vector<Cell> of_master = occupied(raster, master, master_region, {});
  const std::vector<Cell> of_slave = occupied(raster, slave, slave_region, master_from_slave);
  std::vector<Cell> common;
  std::set_intersection(of_master.begin(), of_master.end(), of_slave.begin(), of_slave.end(),
                        std::back_inserter(common));
  if (common.empty()) return std::nullopt;
  Candidate out;
  out.indices_master = inside(raster, master, master_region, {}, common);
  out.indices_slave = inside(raster, slave, slave_region, master_from_slave, common);
  return out.common() >= options.min_points ? std::optional(std::move(out)) : std::nullopt;
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

}  // namespace

std::vector<CommonPlane> find_common_planes(const Cloud& master,
                                            std::span<const PlaneRegion> master_regions,
                                            const Cloud& slave,
                                            std::span<const PlaneRegion> slave_regions,
                                            const RigidTransform& master_from_slave,
                                            const CommonPlaneOptions& options) {
  std::vector<Candidate> candidates;
  for (std::size_t m = 0; m < master_regions.size(); ++m) {
    for (std::size_t s = 0; s < slave_regions.size(); ++s) {
      if (!roughly_coplanar(master_regions[m], slave_regions[s], master_from_slave, options))
        continue;
      auto found = common_area(master, master_regions[m], slave, slave_regions[s],
                               master_from_slave, options);
      if (!found) continue;
      found->master = m;
      found->slave = s;
      candidates.push_back(std::move(*found));
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.common() > b.common(); });

  std::vector<bool> master_taken(master_regions.size()), slave_taken(slave_regions.size());
  std::vector<CommonPlane> pairs;
  for (Candidate& candidate : candidates) {
    if (master_taken[candidate.master] || slave_taken[candidate.slave]) continue;
    CommonPlane pair;
    pair.fit_master = fit_subset(master, candidate.indices_master);
    pair.fit_slave = fit_subset(slave, candidate.indices_slave);
    if (!agree_over_area(pair, master_from_slave, options.max_offset_m)) continue;
    master_taken[candidate.master] = slave_taken[candidate.slave] = true;
    pair.id = static_cast<int>(pairs.size()) + 1;
    pair.indices_master = std::move(candidate.indices_master);
    pair.indices_slave = std::move(candidate.indices_slave);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace alea
