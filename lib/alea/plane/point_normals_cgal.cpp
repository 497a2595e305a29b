#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <utility>

#include "alea/cgal/kernels.hpp"
#include "alea/plane/canonical_points.hpp"

namespace alea {

std::vector<Eigen::Vector3d> point_normals(const std::vector<Eigen::Vector3d>& positions,
                                           std::size_t neighbours) {
  using PointWithNormal = std::pair<Data::Point_3, Data::Vector_3>;
  std::vector<PointWithNormal> points;
  points.reserve(positions.size());
  for (const Eigen::Vector3d& p : positions)
    points.emplace_back(Data::Point_3(p.x(), p.y(), p.z()), Data::Vector_3(0, 0, 0));
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
      points, static_cast<unsigned>(neighbours),
      CGAL::parameters::point_map(CGAL::First_of_pair_property_map<PointWithNormal>())
          .normal_map(CGAL::Second_of_pair_property_map<PointWithNormal>()));
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(points.size());
  for (const PointWithNormal& p : points)
    normals.emplace_back(p.second.x(), p.second.y(), p.second.z());
  return normals;
}

}  // namespace alea
