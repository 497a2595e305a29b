#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "alea/die/die_shape.hpp"
#include "alea/die/observed_die.hpp"

namespace alea {

/// One of the 24 frames of a die: 8 corners with any of their three facets up (Figure 8 of Chan et
/// al. 2023). The letters are tied to the geometry: Z points up along the edge of the two sides, X
/// and Y point into the die along the edges of the upper facet with `x_side` and `y_side`, and X,
/// Y, Z is right-handed.
struct FrameLabel {
  int up = 0;      ///< pips of the upper facet
  int x_side = 0;  ///< pips of the side that meets the upper facet in X
  int y_side = 0;  ///< pips of the side that meets the upper facet in Y

  bool operator==(const FrameLabel&) const = default;
};

/// The axes named by the pips of the facets that meet in them, X, Y, Z: e.g. "1x2 1x3 2x3".
std::string axis_names(const FrameLabel& label);

/// The 24 labels of a die of this hand, ordered by corner and upper facet.
std::vector<FrameLabel> all_frame_labels(Chirality chirality);

/// A corner with its three edges as axes, not orthogonalised.
struct CornerFrame {
  FrameLabel label;
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();     ///< unit columns X, Y, Z: the edges
  Eigen::Matrix3d normals = Eigen::Matrix3d::Identity();  ///< unit columns: y_side, x_side inward,
                                                          ///< up outward; near X, Y, Z
};

/// Builds the frame of an observed corner with the facet `up_pips` up. Corner and edges are
/// intersections in exact arithmetic and are rounded once; which side is X and which Y is decided
/// exactly. Empty where the planes have no single common point. Throws Error(usage) where the die
/// does not show `up_pips` or its labels do not meet at a corner.
std::optional<CornerFrame> corner_frame(const ObservedDie& die, int up_pips);

/// The facet that the paper would call the upper one: among the shared facets (among the master's
/// where none is shared) the one whose normals point up the most, summed over both scans.
int upper_pips(const ObservedDie& master, const ObservedDie& slave);

}  // namespace alea
