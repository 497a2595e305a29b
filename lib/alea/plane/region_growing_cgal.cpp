#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/property_map.h>

#include <iterator>
#include <numbers>
#include <utility>

#include "alea/cgal/kernels.hpp"
#include "alea/plane/canonical_points.hpp"
#include "alea/plane/detectors.hpp"
#include "alea/plane/region_refit.hpp"

namespace alea {
namespace {

using Oriented = std::pair<Data::Point_3, Data::Vector_3>;
using OrientedPoints = std::vector<Oriented>;
using PointMap = CGAL::First_of_pair_property_map<Oriented>;
using NormalMap = CGAL::Second_of_pair_property_map<Oriented>;
namespace growing = CGAL::Shape_detection::Point_set;
using Neighbours = growing::K_neighbor_query<Data, OrientedPoints, PointMap>;
using PlaneFitting =
    growing::Least_squares_plane_fit_region<Data, OrientedPoints, PointMap, NormalMap>;
using Sorting =
    growing::Least_squares_plane_fit_sorting<Data, OrientedPoints, Neighbours, PointMap>;
using Growing = CGAL::Shape_detection::Region_growing<OrientedPoints, Neighbours, PlaneFitting,
                                                      Sorting::Seed_map>;

OrientedPoints oriented_points(const CanonicalPoints& points, std::size_t neighbours) {
  const std::vector<Eigen::Vector3d> normals = point_normals(points.positions, neighbours);
  OrientedPoints out;
  out.reserve(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Eigen::Vector3d& p = points.positions[i];
    const Eigen::Vector3d& n = normals[i];
    out.emplace_back(Data::Point_3(p.x(), p.y(), p.z()), Data::Vector_3(n.x(), n.y(), n.z()));
  }
  return out;
}

}  // namespace

std::vector<PlaneRegion> detect_by_region_growing(const Cloud& cloud,
                                                  const PlaneDetectionOptions& options) {
  const CanonicalPoints points = canonical_points(cloud, options.tolerance_m);
  if (points.positions.size() < options.min_points) return {};
  const OrientedPoints oriented = oriented_points(points, options.neighbours);
  Neighbours neighbours(oriented, options.neighbours);
  PlaneFitting fitting(oriented, options.tolerance_m * points.per_unit,
                       options.normal_angle_rad * 180 / std::numbers::pi, options.min_points);
  Sorting sorting(oriented, neighbours);
  sorting.sort();
  Growing growth(oriented, neighbours, fitting, sorting.seed_map());
  std::vector<std::vector<std::size_t>> found;
  growth.detect(std::back_inserter(found));

  std::vector<std::int32_t> plane_of_point(cloud.size(), -1);
  for (std::size_t plane = 0; plane < found.size(); ++plane)
    for (const std::size_t i : found[plane])
      plane_of_point[points.index[i]] = static_cast<std::int32_t>(plane);
  return refitted_regions(cloud, std::move(plane_of_point), found.size(), options);
}

}  // namespace alea
