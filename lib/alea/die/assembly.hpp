#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "alea/core/plane.hpp"

namespace alea {

/// A corner of three facets, constructed and decided exactly from the planes' doubles, rounded once
/// at the end.
struct CornerAssembly {
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  /// Half the width of the smallest double interval that holds the exact corner (m): the rounding,
  /// not the noise.
  Eigen::Vector3d corner_rounding_m = Eigen::Vector3d::Zero();
  /// edges[k] is where planes (k+1)%3 and (k+2)%3 meet; its direction is n(k+1) x n(k+2), its point
  /// the corner.
  std::array<Line, 3> edges;
  bool corner_on_planes = false;  ///< the exact corner lies on all three planes (before rounding)
  int orientation = 0;            ///< exact sign of det(n0, n1, n2)
};

/// Assembles the corner of three planes; empty where the planes have no single common point
/// (decided exactly).
std::optional<CornerAssembly> assemble_corner(const std::array<Plane, 3>& planes);

}  // namespace alea
