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
    : corner_(corner), domain_(domain), scanner_(scanner_position) {
  for (int k = 0; k < 3; ++k) {
    scanner_height_m_[k] = corner.planes[k].normal.dot(scanner_position - corner.corner_m);
    Eigen::Matrix3d frame;
    frame.col(0) = corner.edges[(k + 1) % 3];
    frame.col(1) = corner.edges[(k + 2) % 3];
    frame.col(2) = corner.planes[k].normal;
    duals_[k] = frame.inverse().topRows<2>().transpose();
  }
}

std::optional<FacetPlace> FacetPlacer::place(int k, const Eigen::Vector3d& p) const {
  FacetPlace out;
  std::array<double, 3> height{};
  for (int j = 0; j < 3; ++j) height[j] = corner_.planes[j].normal.dot(p - corner_.corner_m);
  out.height_m = height[k];
  out.nearest = true;
  if (domain_ == SelectionDomain::coordinate) {
    for (int j = 0; j < 3; ++j) out.nearest &= std::abs(height[k]) <= std::abs(height[j]);
    out.uv_m = duals_[k].transpose() * (p - corner_.corner_m);
    return out;
  }
  // The ray scanner + t (p - scanner) meets plane j at t = scanner height / (fall along the ray).
  const auto meets_at = [&](int j) {
    const double fall = scanner_height_m_[j] - height[j];
    return fall > 0 && scanner_height_m_[j] > 0 ? scanner_height_m_[j] / fall
                                                : -std::numeric_limits<double>::infinity();
  };
  const double t = meets_at(k);
  if (!(t > 0)) return std::nullopt;
  for (int j = 0; j < 3; ++j) out.nearest &= t >= meets_at(j);
  out.uv_m = duals_[k].transpose() * (scanner_ + t * (p - scanner_) - corner_.corner_m);
  return out;
}

double corner_sine(const FacetCorner& corner, int k) {
  return corner.edges[(k + 1) % 3].cross(corner.edges[(k + 2) % 3]).norm();
}

}  // namespace alea
