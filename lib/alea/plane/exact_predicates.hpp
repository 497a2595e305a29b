#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "alea/core/plane.hpp"

namespace alea {

/// The exact sign (-1, 0, +1) of det(a, b, c), the doubles taken as they are.
int exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether the planes' normals are exactly parallel or opposite, the doubles taken as they are.
bool exactly_parallel(const Plane& a, const Plane& b);

/// The exact sign (-1, 0, +1) of a . b.
int exact_sign_of_dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// What the exact kernel says about three planes that may be the facets of one convex corner. The
/// doubles are taken as exact numbers, so every answer is a yes or a no without a tolerance.
struct CornerDecision {
  bool single_point = false;   ///< the planes meet in one point
  bool convex = false;         ///< each facet's centre lies strictly inside the other two planes
  bool faces_scanner = false;  ///< the scanner lies strictly outside all three (true without one)
  bool accepted() const { return single_point && convex && faces_scanner; }
};

/// `planes` with outward normals, `centres_m` a point of each facet.
CornerDecision decide_corner(const std::array<Plane, 3>& planes,
                             const std::array<Eigen::Vector3d, 3>& centres_m,
                             const std::optional<Eigen::Vector3d>& scanner_position);

}  // namespace alea
