#include "alea/facet/facet_extent.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "alea/core/order_free_sum.hpp"

namespace alea {
namespace {

/// A facet's points: where their rays meet it and the area that each stands for (per step^2).
struct Footprints {
  std::vector<Eigen::Vector2d> uv_m;
  std::vector<double> area_m2;
  std::vector<Eigen::Vector2d> about_m;  // the same and what is near its plane
};

/// Area that a step of the scanner's grid covers, per step^2. Columns close up towards the poles of
/// the scan's own z axis: without the cosine of the elevation a wall seen from above grows longer
/// downwards, by 3 mm in 0.5 m at 4 m.
double area_of_step(const Eigen::Vector3d& ray, double towards) {
  constexpr double least_cosine = 0.05;  // about the poles the grid says little
  const double range = ray.norm();
  const double cosine = std::max(least_cosine, ray.head<2>().norm() / range);
  return cosine * range * range * range / std::max(1e-6, towards);
}

Footprints footprints_on(std::span<const Eigen::Vector3d> points, const FacetCorner& corner, int k,
                         const Eigen::Vector2d& rough_m, const ExtentOptions& options) {
  const FacetPlacer placer(corner, SelectionDomain::ray, options.scanner_position);
  const Eigen::Vector3d& normal = corner.planes[k].normal;
  Footprints out;
  for (const Eigen::Vector3d& p : points) {
    const PlacedPoint placed = placer.approach(p);
    if (placed.nearest != k || !placed.meets[k]) continue;
    const Eigen::Vector2d uv = placer.uv_m(k, p, placed);
    if ((uv.array() > 1.3 * rough_m.array()).any()) continue;
    const double height = placed.height_m[k];
    out.about_m.push_back(uv);
    if (height > options.outside_gate_m || height < -options.inside_gate_m) continue;
    const Eigen::Vector3d ray = p - options.scanner_position;
    out.uv_m.push_back(uv);
    out.area_m2.push_back(area_of_step(ray, -normal.dot(ray)));
  }
  return out;
}

/// Sum of the areas with coordinate `axis` in (from, to].
double area_between(const Footprints& points, int axis, double from, double to) {
  double largest = 0;
  for (const double area : points.area_m2) largest = std::max(largest, area);
  OrderFreeSum<1> sum({largest}, points.uv_m.size());
  for (std::size_t i = 0; i < points.uv_m.size(); ++i)
    if (points.uv_m[i][axis] > from && points.uv_m[i][axis] <= to) sum.add(0, points.area_m2[i]);
  return sum.total(0);
}

/// The end of the stretch of points that holds the middle of the rough length: two bins in a row
/// with less than a quarter of the usual count end it.
double end_of_stretch(const Footprints& points, int axis, double rough_m, double bin_m) {
  const auto bins = static_cast<std::size_t>(std::ceil(1.3 * rough_m / bin_m)) + 1;
  std::vector<int> count(bins, 0);
  for (const Eigen::Vector2d& uv : points.uv_m) {
    const double bin = std::floor(uv[axis] / bin_m);
    if (bin >= 0 && bin < static_cast<double>(bins)) ++count[static_cast<std::size_t>(bin)];
  }
  const auto middle = static_cast<std::size_t>(0.5 * rough_m / bin_m);
  std::vector<int> inner(count.begin(),
                         count.begin() + static_cast<std::ptrdiff_t>(2 * middle) + 1);
  std::nth_element(inner.begin(), inner.begin() + static_cast<std::ptrdiff_t>(middle), inner.end());
  const int few = inner[middle] / 4;
  std::size_t end = middle;
  while (end + 2 < bins && (count[end + 1] > few || count[end + 2] > few)) ++end;
  return static_cast<double>(end + 1) * bin_m;
}

/// Largest spacing of the points along an edge (m), from the area that a step of the grid covers:
/// that of the grid's lines where they run along the other edge, as columns do on an upright die.
Eigen::Vector2d spacing_of(const Footprints& points, const FacetCorner& corner, int k,
                           const Eigen::Vector2d& rough_m, const ExtentOptions& options) {
  const Eigen::Vector3d &e_u = corner.edges[(k + 1) % 3], &e_v = corner.edges[(k + 2) % 3];
  const Eigen::Vector3d middle =
      corner.corner_m + 0.5 * rough_m.x() * e_u + 0.5 * rough_m.y() * e_v;
  const Eigen::Vector3d ray = middle - options.scanner_position;
  Footprints inner;
  for (std::size_t i = 0; i < points.uv_m.size(); ++i) {
    const Eigen::Array2d share = points.uv_m[i].array() / rough_m.array();
    if ((share < 0.2).any() || (share > 0.8).any()) continue;
    inner.uv_m.push_back(points.uv_m[i]), inner.area_m2.push_back(points.area_m2[i]);
  }
  const double covered = inner.uv_m.empty() ? 0 : area_between(inner, 0, 0, rough_m.x());
  const double area = 0.36 * rough_m.prod() * e_u.cross(e_v).norm();
  const double step = covered > 0 ? std::sqrt(area / covered) : rough_m.minCoeff() / ray.norm() / 4;
  const Eigen::Vector3d towards = ray.normalized();
  const double facing = std::max(0.02, std::abs(e_u.cross(e_v).dot(towards)));
  const auto across_lines_along = [&](const Eigen::Vector3d& other) {
    return step * ray.norm() * other.cross(towards).norm() / facing;
  };
  return {across_lines_along(e_v), across_lines_along(e_u)};
}

/// Incidence (rad) at a far border, in the plane across that border.
double incidence_across(const FacetCorner& corner, int k, const Eigen::Vector3d& border,
                        const Eigen::Vector3d& ray) {
  const Eigen::Vector3d across = ray - border.dot(ray) * border;
  const double cosine = -corner.planes[k].normal.dot(across) / std::max(1e-12, across.norm());
  return std::acos(std::clamp(cosine, 0.0, 1.0));
}

/// Whether points near the facet's plane go on beyond its end: at least half as many in the next
/// bins as inside it.
bool goes_on(const Footprints& points, int axis, double end_m, double bin_m) {
  double beyond = 0, inside = 0;
  for (const Eigen::Vector2d& uv : points.about_m) {
    beyond += uv[axis] > end_m + bin_m && uv[axis] <= end_m + 3 * bin_m ? 1 : 0;
    inside += uv[axis] > end_m - 6 * bin_m && uv[axis] <= end_m - 2 * bin_m ? 1 : 0;
  }
  return 4 * beyond > inside;
}

void measure_axis(const Footprints& facet, const FacetCorner& corner, int k, int axis,
                  double rough_m, double spacing_m, const ExtentOptions& options,
                  FacetExtent& out) {
  const double bin = std::max(1.01 * spacing_m, rough_m / 200);
  const double end = end_of_stretch(facet, axis, rough_m, bin);
  const double from = 0.1 * end, to = 0.6 * end;
  const double per_metre = area_between(facet, axis, from, to) / (to - from);
  out.high_m[axis] =
      per_metre > 0 ? to + area_between(facet, axis, to, end + bin) / per_metre : end;
  out.border_m[axis] = out.length_m[axis] = out.high_m[axis];
  // Of its end, and of the density that it is measured by.
  out.sampling_sd_m[axis] = 0.5 * spacing_m;
  if (goes_on(facet, axis, end, bin)) {
    out.hidden_sd_m[axis] = options.outside_gate_m / 2;
    return;
  }
  const Eigen::Vector3d& along = corner.edges[(k + 1 + axis) % 3];
  const Eigen::Vector3d& border = corner.edges[(k + 2 - axis) % 3];
  const Eigen::Vector3d ray = corner.corner_m + end * along - options.scanner_position;
  const double hidden =
      options.edge_radius_m * hidden_share(incidence_across(corner, k, border, ray));
  out.border_m[axis] += hidden;
  // A beam is lost at the border by up to half its footprint, by nothing where it is a point.
  out.length_m[axis] += hidden + options.footprint_m / 4;
  out.hidden_sd_m[axis] = std::hypot(0.3 * hidden, options.footprint_m / 4);
}

}  // namespace

double hidden_share(double incidence_rad) {
  const double i = std::clamp(incidence_rad, 0.0, 1.55);
  return (1 - std::cos(i)) + (1 - std::sin(i)) * std::tan(i);
}

std::array<FacetExtent, 3> measure_extents(std::span<const Eigen::Vector3d> points,
                                           const FacetCorner& corner,
                                           const std::array<Eigen::Vector2d, 3>& rough_lengths_m,
                                           const ExtentOptions& options) {
  std::array<FacetExtent, 3> out;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d& rough = rough_lengths_m[k];
    const Footprints facet = footprints_on(points, corner, k, rough, options);
    out[k].sampling_sd_m = rough;  // nothing is known of a facet without points
    if (facet.uv_m.size() < 4) continue;
    const Eigen::Vector2d spacing = spacing_of(facet, corner, k, rough, options);
    out[k].low_m = facet.uv_m[0];
    for (const Eigen::Vector2d& uv : facet.uv_m) out[k].low_m = out[k].low_m.cwiseMin(uv);
    for (int axis = 0; axis < 2; ++axis)
      measure_axis(facet, corner, k, axis, rough[axis], spacing[axis], options, out[k]);
  }
  return out;
}

}  // namespace alea
