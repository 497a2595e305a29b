#pragma once

#include <Eigen/Core>

#include "alea/die/corner_frame.hpp"

namespace alea {

/// How the edges at a corner, which are not quite perpendicular, become an orthonormal frame.
enum class FrameRule {
  fix_x,       ///< X stays, Y is the normal of Z and X, Z follows
  fix_y,       ///< Y stays, Z is the normal of X and Y, X follows
  fix_z,       ///< Z stays, X is the normal of Y and Z, Y follows: the paper's equations (1) to (3)
  polar,       ///< the rotation nearest to the three edges (least squares)
  top_normal,  ///< the upper facet's normal stays, then X
  mean_heading,  ///< the upper facet's normal stays, then the mean heading of the two sides
};

/// Equations (1) to (3) of Chan et al. 2023 for the chosen rule, cyclic in the letters; unit
/// columns, right-handed. Equation (3) is printed as V_y = V_x x V_z, which is left-handed; here
/// V_y = V_z x V_x.
Eigen::Matrix3d orthogonal_axes(const CornerFrame& frame, FrameRule rule);

/// Equations (1) to (3) as printed: V_y points the wrong way and the frame is left-handed. Only for
/// showing the damage.
Eigen::Matrix3d orthogonal_axes_as_printed(const CornerFrame& frame);

/// Alea's frame: the edge of two facets named by their pips, then the normal of `normal_pips`, one
/// of the two. The same physical directions wherever both facets are seen, so a die that is not
/// cubic leaks nothing. The edge points along n(first) x n(second).
Eigen::Matrix3d edge_axes(const ObservedDie& die, int first_pips, int second_pips, int normal_pips);

/// The same edge with the mean of both normals as second direction, which uses both alike.
Eigen::Matrix3d edge_axes(const ObservedDie& die, int first_pips, int second_pips);

}  // namespace alea
