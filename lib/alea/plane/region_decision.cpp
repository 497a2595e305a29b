#include "alea/plane/region_decision.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include "alea/plane/region_fit.hpp"

namespace alea {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices points_inside(const Cloud& cloud, const RegionBall& ball) {
  Indices out;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if ((cloud.positions[i] - ball.centre_m).squaredNorm() <= ball.radius_m * ball.radius_m)
      out.push_back(i);
  return out;
}

/// CGAL's planes of these points, as regions of the whole cloud.
std::vector<PlaneRegion> propose(const Cloud& cloud, const Indices& inside,
                                 const RegionDecisionOptions& options) {
  Cloud part;
  for (const std::uint32_t i : inside) part.positions.push_back(cloud.positions[i]);
  part.scanner_position = cloud.scanner_position;
  PlaneDetectionOptions detection;
  detection.detector = PlaneDetector::efficient_ransac;
  detection.tolerance_m = options.tolerance_m;
  detection.min_points = options.min_points;
  detection.seed = options.seed;
  detection.normal_angle_rad = std::numbers::pi / 2;
  std::vector<PlaneRegion> out = detect_planes(part, detection);
  for (PlaneRegion& region : out)
    for (std::uint32_t& i : region.indices) i = inside[i];
  return out;
}

/// Where a region's points end along its two axes, on its plane, and its centroid: what must lie
/// near another plane for the two to be one.
std::vector<Eigen::Vector3d> outline(const Cloud& cloud, const PlaneRegion& region) {
  const Eigen::Matrix<double, 3, 2> axes = tangent_basis(region.plane.normal);
  Eigen::Array2d low = Eigen::Array2d::Zero(), high = low;
  for (const std::uint32_t i : region.indices) {
    const Eigen::Array2d at = (axes.transpose() * (cloud.positions[i] - region.centroid_m)).array();
    low = low.min(at);
    high = high.max(at);
  }
  std::vector<Eigen::Vector3d> out{region.centroid_m};
  for (const double u : {low.x(), high.x()})
    for (const double v : {low.y(), high.y()})
      out.push_back(region.centroid_m + axes * Eigen::Vector2d(u, v));
  return out;
}

bool on_plane(const Cloud& cloud, const PlaneRegion& region, const Plane& plane,
              double tolerance_m) {
  return exactly_within(outline(cloud, region), plane, tolerance_m);
}

/// A candidate with what is known of it.
struct Judged {
  const PlaneRegion* region;
  bool inside;              ///< all of it lies in the ball
  std::vector<bool> plane;  ///< for each of CGAL's planes: whether it lies on it
};

std::vector<Judged> judge(const Cloud& cloud, const std::vector<PlaneRegion>& candidates,
                          const std::vector<PlaneRegion>& proposed, const Indices& inside,
                          const RegionDecisionOptions& options) {
  std::vector<Judged> out;
  for (const PlaneRegion& candidate : candidates) {
    Judged judged{&candidate,
                  std::includes(inside.begin(), inside.end(), candidate.indices.begin(),
                                candidate.indices.end()),
                  {}};
    for (const PlaneRegion& plane : proposed)
      // Either outline on the other plane: the smaller set's plane is the worse known one.
      judged.plane.push_back(on_plane(cloud, candidate, plane.plane, options.tolerance_m) ||
                             on_plane(cloud, plane, candidate.plane, options.tolerance_m));
    out.push_back(std::move(judged));
  }
  return out;
}

Indices united(const Indices& a, const Indices& b) {
  Indices out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

Indices without(const Indices& a, const Indices& b) {
  Indices out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace

std::vector<PlaneRegion> decide_regions(const Cloud& cloud,
                                        const std::vector<PlaneRegion>& candidates,
                                        const RegionBall& ball,
                                        const RegionDecisionOptions& options) {
  const Indices inside = points_inside(cloud, ball);
  if (inside.size() < options.min_points || inside.size() > options.most_points) return candidates;
  const std::vector<PlaneRegion> proposed = propose(cloud, inside, options);
  const std::vector<Judged> judged = judge(cloud, candidates, proposed, inside, options);

  std::vector<PlaneRegion> out;
  Indices taken;
  std::vector<Indices> confirmed(proposed.size());
  std::vector<bool> known(proposed.size(), false);
  for (const Judged& candidate : judged) {
    const auto first = std::find(candidate.plane.begin(), candidate.plane.end(), true);
    for (std::size_t p = 0; p < proposed.size(); ++p) known[p] = known[p] || candidate.plane[p];
    if (!candidate.inside) {
      out.push_back(*candidate.region);
    } else if (first != candidate.plane.end()) {
      Indices& members = confirmed[static_cast<std::size_t>(first - candidate.plane.begin())];
      members = united(members, candidate.region->indices);
    } else {
      continue;
    }
    taken = united(taken, candidate.region->indices);
  }
  for (std::size_t p = 0; p < proposed.size(); ++p) {
    Indices members = known[p] ? confirmed[p] : without(proposed[p].indices, taken);
    if (members.size() >= options.min_points) out.push_back(fit_region(cloud, std::move(members)));
  }
  std::sort(out.begin(), out.end(), comes_first);
  return out;
}

}  // namespace alea
