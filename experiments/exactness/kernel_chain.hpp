#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "alea/core/plane.hpp"

namespace alea::experiments::exactness {

/// Three facets about a corner and a fourth plane that may cut the corner off; outward normals.
struct CornerPlanes {
  std::array<Plane, 3> facets;
  Plane cap;
};

/// What a kernel says of them. Where two of the planes do not meet, the decisions that need the
/// corner are false.
struct CornerDecisions {
  bool orientation = false;  ///< det(n0, n1, n2) > 0
  /// The corner and the three points where its edges leave the cap turn left: the hand of the die
  /// from constructed points.
  bool chirality = false;
  bool adjacency = false;  ///< the corner is inside the cap, so the facets meet in pairs there
  bool closure = false;    ///< all four points lie inside the plane that each does not lie on
  bool on_planes = false;  ///< the corner constructed lies on its three planes
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();  ///< rounded to doubles
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< edge 0-1, normal 0, and across; columns
};

/// The chain in one kernel of CGAL: "double" (Simple_cartesian<double>), "epick" or "epeck".
CornerDecisions decide_by(const std::string& kernel, const CornerPlanes& planes);

}  // namespace alea::experiments::exactness
