#include "alea/facet/facet_neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/parallel.hpp"

namespace alea {

FacetNeighbourhood points_about(const Cloud& cloud, const FacetCorner& corner,
                                const std::array<Eigen::Vector2d, 3>& lengths_m, double depth_m) {
  Eigen::Vector3d middle = corner.corner_m;
  double radius = 0;
  for (int j = 0; j < 3; ++j) {
    const double edge = std::max(lengths_m[(j + 2) % 3][0], lengths_m[(j + 1) % 3][1]);
    middle += 0.5 * edge * corner.edges[j];
    radius += edge * edge;
  }
  radius = 0.6 * std::sqrt(radius);
  constexpr std::size_t chunk = 1 << 15;
  std::vector<std::vector<std::uint32_t>> found((cloud.size() + chunk - 1) / chunk);
  parallel_chunks(cloud.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& p = cloud.positions[i];
      if ((p - middle).squaredNorm() > radius * radius) continue;
      double height = -depth_m - 1;
      for (const Plane& plane : corner.planes)
        height = std::max(height, plane.normal.dot(p - corner.corner_m));
      if (std::abs(height) <= depth_m)
        found[begin / chunk].push_back(static_cast<std::uint32_t>(i));
    }
  });
  FacetNeighbourhood out;
  for (const auto& part : found) out.indices.insert(out.indices.end(), part.begin(), part.end());
  out.points.reserve(out.indices.size());
  for (const std::uint32_t i : out.indices) out.points.push_back(cloud.positions[i]);
  return out;
}

std::array<Eigen::Vector2d, 3> rough_lengths(const Cloud& cloud, const FacetCorner& corner,
                                             const std::array<PlaneRegion, 3>& regions) {
  std::array<Eigen::Vector2d, 3> out;
  const FacetPlacer placer(corner, SelectionDomain::coordinate, Eigen::Vector3d::Zero());
  for (int k = 0; k < 3; ++k) {
    std::array<std::vector<double>, 2> along;
    for (const std::uint32_t i : regions[k].indices) {
      const Eigen::Vector2d uv = placer.uv_m(k, cloud.positions[i], {});
      for (int axis = 0; axis < 2; ++axis) along[axis].push_back(uv[axis]);
    }
    for (int axis = 0; axis < 2; ++axis) {
      if (along[axis].empty()) return {};
      const auto rank = static_cast<std::ptrdiff_t>(0.99 * (along[axis].size() - 1));
      std::nth_element(along[axis].begin(), along[axis].begin() + rank, along[axis].end());
      out[k][axis] = along[axis][rank] / 0.99;
    }
  }
  return out;
}

}  // namespace alea
