#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "alea/core/rigid_transform.hpp"
#include "alea/report/axes.hpp"

namespace alea {

/// A parallel projection: what a viewer far away sees. Metres to metres in the picture.
struct ParallelView {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d to_viewer = Eigen::Vector3d::UnitZ();

  Eigen::Vector2d operator()(const Eigen::Vector3d& p) const { return {right.dot(p), up.dot(p)}; }
  double nearness(const Eigen::Vector3d& p) const { return to_viewer.dot(p); }
};

/// The view from a direction (need not be a unit vector), z upwards; straight from above x to the
/// right and y upwards. Throws Error(usage) for a zero direction.
ParallelView view_from(const Eigen::Vector3d& to_viewer);

/// Smallest and largest of each coordinate, widened by `share` of the larger extent on all sides;
/// (0, 0) and (1, 1) where there are none.
std::pair<Eigen::Vector2d, Eigen::Vector2d> bounds_of(std::span<const Eigen::Vector2d> places,
                                                      double share = 0.05);

/// Draws points so that those nearer to the viewer cover the others. `colours` is as long as
/// `points`.
void draw_points(Axes& axes, const ParallelView& view, std::span<const Eigen::Vector3d> points,
                 std::span<const Rgb> colours, double radius_px = 1);

/// Three arrows from `origin` along the unit columns of `directions`, red, green and blue, with
/// their names at the ends.
void draw_frame_arrows(Axes& axes, const ParallelView& view, const Eigen::Vector3d& origin,
                       const Eigen::Matrix3d& directions, double length_m,
                       const std::array<std::string, 3>& names, int width_px = 2);

}  // namespace alea
