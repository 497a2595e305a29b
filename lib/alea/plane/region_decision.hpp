#pragma once

#include <Eigen/Core>
#include <vector>

#include "alea/plane/plane_detector.hpp"

namespace alea {

/// A place about which candidate regions are decided.
struct RegionBall {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

struct RegionDecisionOptions {
  double tolerance_m = 0.006;  ///< of the detector that proposed the candidates
  std::size_t min_points = 24;
  std::uint64_t seed = 1;
  /// A ball with more points than this is left as it is: the cells see planes there that have so
  /// many points.
  std::size_t most_points = 20000;
};

/// Lets CGAL's detector and the exact kernel decide on the candidate regions of one place. CGAL's
/// Efficient RANSAC runs on the points of the ball alone, without a test of normals (scan rows at a
/// grazing angle have none). Then exactly, for each of its planes: it confirms the candidates that
/// lie on it (their points' box within the tolerance of it, centroid included), or is a new region
/// of the points that no candidate has. Candidates inside the ball that are not confirmed are
/// dropped; candidates that reach out of the ball are kept. Candidates of one plane that lie within
/// the ball are one region. Sorted as detect_planes does; the same bits for any order of the
/// points.
std::vector<PlaneRegion> decide_regions(const Cloud& cloud,
                                        const std::vector<PlaneRegion>& candidates,
                                        const RegionBall& ball,
                                        const RegionDecisionOptions& options);

/// Whether all points lie within `distance` of the plane, decided exactly: |n.p - d| <= distance
/// |n| with the doubles taken as they are.
bool exactly_within(const std::vector<Eigen::Vector3d>& points, const Plane& plane,
                    double distance);

}  // namespace alea
