#include "alea/die/facet_image.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "alea/core/error.hpp"

namespace alea {
namespace {

/// The direction of edge j away from the corner, along the die: inside facet j's plane's halfspace.
Eigen::Vector3d away_from_corner(const Plane& other_facet, const Line& edge) {
  return other_facet.normal.dot(edge.direction) > 0 ? Eigen::Vector3d(-edge.direction)
                                                    : edge.direction;
}

Eigen::Vector2d view_slope(const FacetImageInput& image, const Plane& plane,
                           const Eigen::Vector3d& corner_m, const Eigen::Matrix<double, 3, 2>& axes,
                           const Eigen::Vector3d& scanner_position) {
  const Eigen::Vector3d centre =
      corner_m + axes * Eigen::Vector2d(image.edge_u_m / 2, image.edge_v_m / 2);
  const Eigen::Vector3d ray = (centre - scanner_position).normalized();
  const double cosine = std::abs(plane.normal.dot(ray));
  const double steepest = 1e-3;  // beyond 89.94 deg nothing is seen anyway
  return axes.transpose() * ray / std::max(cosine, steepest);
}

/// Where the scanner's ray to a point meets the plane: noise in the range, or a pip's depth, then
/// moves no mark. Without a scanner, or along the plane, the point itself.
Eigen::Vector3d on_plane(const Eigen::Vector3d& point, const Plane& plane,
                         const std::optional<Eigen::Vector3d>& scanner) {
  if (!scanner) return point;
  const double from = plane.signed_distance(*scanner), to = plane.signed_distance(point);
  constexpr double least_fall = 1e-3;  // of the scanner's height: the ray runs along the plane
  if (!(std::abs(from - to) > least_fall * std::abs(from))) return point;
  return *scanner + from / (from - to) * (point - *scanner);
}

constexpr int levels = 4096;

/// Counts of intensity in 4096 classes of the range; values outside go to its ends.
std::vector<std::uint32_t> histogram(const std::vector<float>& intensity, IntensityRange range) {
  std::vector<std::uint32_t> counts(levels, 0);
  const double scale = (levels - 1) / (range.high - range.low);
  for (const float value : intensity) {
    if (!std::isfinite(value)) continue;
    const double level = std::clamp((value - range.low) * scale, 0.0, levels - 1.0);
    ++counts[static_cast<std::size_t>(level + 0.5)];
  }
  return counts;
}

}  // namespace

IntensityRange intensity_range(const std::vector<float>& intensity) {
  IntensityRange range{std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()};
  for (const float value : intensity) {
    if (!std::isfinite(value)) continue;
    range.low = std::min<double>(range.low, value);
    range.high = std::max<double>(range.high, value);
  }
  for (int pass = 0; pass < 4 && range.high > range.low; ++pass) {
    const std::vector<std::uint32_t> counts = histogram(intensity, range);
    std::uint64_t total = 0;
    for (const std::uint32_t count : counts) total += count;
    const std::uint64_t tail = total / 200;
    std::uint64_t below = 0, above = 0;
    int first = 0, last = levels - 1;
    while (first < last && (below += counts[first]) <= tail) ++first;
    while (last > first && (above += counts[last]) <= tail) --last;
    const double step = (range.high - range.low) / (levels - 1);
    const bool fine_enough = last - first >= levels / 8;
    range = {range.low + step * (first - 1), range.low + step * (last + 1)};
    if (fine_enough) break;
  }
  return range;
}

std::array<FacetImageInput, 3> facet_images(
    const Cloud& cloud, const std::array<std::span<const std::uint32_t>, 3>& indices,
    const std::array<Plane, 3>& planes, const CornerAssembly& corner,
    const std::array<double, 3>& edges_m) {
  if (!cloud.has_intensity())
    throw input_error("the scan has no intensity, which the pips need: export it with intensity");
  std::array<FacetImageInput, 3> images;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t along_u = (k + 1) % 3, along_v = (k + 2) % 3;
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = away_from_corner(planes[along_u], corner.edges[along_u]);
    axes.col(1) = away_from_corner(planes[along_v], corner.edges[along_v]);
    const Eigen::Matrix<double, 2, 3> uv_from_xyz =
        (axes.transpose() * axes).inverse() * axes.transpose();

    FacetImageInput& image = images[k];
    image.edge_u_m = edges_m[along_u];
    image.edge_v_m = edges_m[along_v];
    image.uv_m.reserve(indices[k].size());
    image.intensity.reserve(indices[k].size());
    for (const std::uint32_t i : indices[k]) {
      const Eigen::Vector3d place = on_plane(cloud.positions[i], planes[k], cloud.scanner_position);
      image.uv_m.emplace_back(uv_from_xyz * (place - corner.corner_m));
      image.intensity.push_back(cloud.intensity[i]);
    }
    if (cloud.scanner_position)
      image.view_slope =
          view_slope(image, planes[k], corner.corner_m, axes, *cloud.scanner_position);
  }
  return images;
}

}  // namespace alea
