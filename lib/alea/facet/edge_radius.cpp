#include "alea/facet/edge_radius.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "alea/core/order_free_sum.hpp"

namespace alea {
namespace {

constexpr std::size_t depth_bins = 64;
constexpr double end_share = 0.15;  // of an edge, left out at both ends: corners have three planes

/// Mean depth t of the points in bins of s, over all three edges.
struct Profile {
  double reach_m;
  std::array<double, depth_bins> mean_t{};
  std::array<double, depth_bins> count{};
  double s_at(std::size_t bin) const {
    return reach_m * (2 * (static_cast<double>(bin) + 0.5) / depth_bins - 1);
  }
};

Profile measure_profile(std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
                        const std::array<double, 3>& edges_m, double reach_m) {
  std::array<double, depth_bins> bounds{};
  bounds.fill(4 * reach_m);
  OrderFreeSum<depth_bins> sums(bounds, std::max<std::size_t>(1, 3 * points.size()));
  Profile out{reach_m, {}, {}};
  for (const Eigen::Vector3d& p : points) {
    std::array<double, 3> depth{};
    for (int k = 0; k < 3; ++k) depth[k] = -corner.planes[k].normal.dot(p - corner.corner_m);
    for (int j = 0; j < 3; ++j) {
      if (depth[j] < end_share * edges_m[j] || depth[j] > (1 - end_share) * edges_m[j]) continue;
      const double a = depth[(j + 1) % 3], b = depth[(j + 2) % 3];
      const double s = (a - b) / std::numbers::sqrt2, t = (a + b) / std::numbers::sqrt2;
      if (std::abs(s) >= reach_m || std::abs(t) >= 2 * reach_m) continue;
      const auto bin =
          std::min(depth_bins - 1, static_cast<std::size_t>((s / reach_m + 1) / 2 * depth_bins));
      // A point that lies on neither surface (behind the silhouette, in front) says nothing.
      if (t - std::abs(s) > 0.45 * reach_m || t - std::abs(s) < -0.1 * reach_m) continue;
      sums.add(bin, t - std::abs(s));
      out.count[bin] += 1;
    }
  }
  for (std::size_t k = 0; k < depth_bins; ++k)
    if (out.count[k] > 0) out.mean_t[k] = sums.total(k) / out.count[k];
  return out;
}

double misfit(const Profile& profile, double radius_m) {
  double sum = 0;
  for (std::size_t k = 0; k < depth_bins; ++k) {
    const double s = std::abs(profile.s_at(k));
    const bool round = s < radius_m / std::numbers::sqrt2;
    const double cut =
        round ? std::numbers::sqrt2 * radius_m - std::sqrt(radius_m * radius_m - s * s) - s : 0;
    sum += profile.count[k] * (profile.mean_t[k] - cut) * (profile.mean_t[k] - cut);
  }
  return sum;
}

}  // namespace

double estimate_edge_radius(std::span<const Eigen::Vector3d> points, const FacetCorner& corner,
                            const std::array<Eigen::Vector2d, 3>& lengths_m) {
  std::array<double, 3> edges_m{};
  for (int j = 0; j < 3; ++j)
    edges_m[j] = std::min(lengths_m[(j + 2) % 3][0], lengths_m[(j + 1) % 3][1]);
  const double shortest = *std::min_element(edges_m.begin(), edges_m.end());
  const double reach = shortest / 7;
  const Profile profile = measure_profile(points, corner, edges_m, reach);
  constexpr int steps = 280;
  int best = 0;
  double least = misfit(profile, 0);
  for (int i = 1; i <= steps; ++i) {
    const double value = misfit(profile, reach * i / steps);
    if (value < least) best = i, least = value;
  }
  return reach * best / steps;
}

}  // namespace alea
