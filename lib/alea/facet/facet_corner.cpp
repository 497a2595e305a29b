#include "alea/facet/facet_corner.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace alea {

std::optional<FacetCorner> facet_corner(const std::array<Plane, 3>& planes) {
  FacetCorner out;
  out.planes = planes;
  Eigen::Matrix3d normals;
  Eigen::Vector3d offsets;
  for (int k = 0; k < 3; ++k) {
    normals.row(k) = planes[k].normal;
    offsets[k] = planes[k].offset_m;
  }
  const double volume = normals.determinant();
  if (std::abs(volume) < 1e-6) return std::nullopt;
  out.corner_m = normals.partialPivLu().solve(offsets);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d along = planes[(k + 1) % 3].normal.cross(planes[(k + 2) % 3].normal);
    // Into the body: against the outward normal of the facet that the edge leaves.
    out.edges[k] = along.normalized() * (along.dot(planes[k].normal) > 0 ? -1.0 : 1.0);
  }
  return out;
}

FacetPlacer::FacetPlacer(const FacetCorner& corner, SelectionDomain domain,
                         const Eigen::Vector3d& scanner_position)
    : corner_(corner), domain_(domain), scanner_(scanner_position - corner.corner_m) {
  for (int k = 0; k < 3; ++k) {
    scanner_height_m_[k] = corner.planes[k].normal.dot(scanner_);
    Eigen::Matrix3d frame;
    frame.col(0) = corner.edges[(k + 1) % 3];
    frame.col(1) = corner.edges[(k + 2) % 3];
    frame.col(2) = corner.planes[k].normal;
    duals_[k] = frame.inverse().topRows<2>();
  }
}

double corner_sine(const FacetCorner& corner, int k) {
  return corner.edges[(k + 1) % 3].cross(corner.edges[(k + 2) % 3]).norm();
}

}  // namespace alea
