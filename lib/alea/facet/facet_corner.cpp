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

PlacedPoint FacetPlacer::approach(const Eigen::Vector3d& p) const {
  PlacedPoint out;
  for (int k = 0; k < 3; ++k) out.height_m[k] = corner_.planes[k].normal.dot(p - corner_.corner_m);
  if (domain_ == SelectionDomain::coordinate) {
    out.meets.fill(true);
    for (int k = 1; k < 3; ++k)
      if (std::abs(out.height_m[k]) < std::abs(out.height_m[out.nearest])) out.nearest = k;
    return out;
  }
  // The ray scanner + t (p - scanner) meets plane k at t = scanner height / (fall along the ray).
  for (int k = 0; k < 3; ++k) {
    const double fall = scanner_height_m_[k] - out.height_m[k];
    out.meets[k] = fall > 0 && scanner_height_m_[k] > 0;
    out.at[k] = out.meets[k] ? scanner_height_m_[k] / fall : 0;
    if (out.at[k] > out.at[out.nearest]) out.nearest = k;
  }
  return out;
}

Eigen::Vector2d FacetPlacer::uv_m(int k, const Eigen::Vector3d& p,
                                  const PlacedPoint& placed) const {
  const Eigen::Vector3d from_corner = p - corner_.corner_m;
  if (domain_ == SelectionDomain::coordinate) return duals_[k] * from_corner;
  return duals_[k] * (scanner_ + placed.at[k] * (from_corner - scanner_));
}

double corner_sine(const FacetCorner& corner, int k) {
  return corner.edges[(k + 1) % 3].cross(corner.edges[(k + 2) % 3]).norm();
}

}  // namespace alea
