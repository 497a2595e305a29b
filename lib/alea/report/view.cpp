#include "alea/report/view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "alea/core/error.hpp"

namespace alea {

ParallelView view_from(const Eigen::Vector3d& to_viewer) {
  if (!(to_viewer.norm() > 0)) throw usage_error("view_from: a direction of length zero");
  ParallelView view;
  view.to_viewer = to_viewer.normalized();
  const Eigen::Vector3d side = Eigen::Vector3d::UnitZ().cross(view.to_viewer);
  view.right = side.norm() > 1e-6 ? side.normalized() : Eigen::Vector3d::UnitX().eval();
  view.up = view.to_viewer.cross(view.right);
  return view;
}

std::pair<Eigen::Vector2d, Eigen::Vector2d> bounds_of(std::span<const Eigen::Vector2d> places,
                                                      double share) {
  if (places.empty()) return {Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()};
  Eigen::Vector2d low = places[0], high = places[0];
  for (const Eigen::Vector2d& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double margin = std::max(share * (high - low).maxCoeff(), 1e-9);
  return {low - Eigen::Vector2d::Constant(margin), high + Eigen::Vector2d::Constant(margin)};
}

void draw_points(Axes& axes, const ParallelView& view, std::span<const Eigen::Vector3d> points,
                 std::span<const Rgb> colours, double radius_px) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return view.nearness(points[a]) < view.nearness(points[b]);
  });
  for (const std::size_t i : order) axes.point(view(points[i]), colours[i], radius_px);
}

void draw_frame_arrows(Axes& axes, const ParallelView& view, const Eigen::Vector3d& origin,
                       const Eigen::Matrix3d& directions, double length_m,
                       const std::array<std::string, 3>& names, int width_px) {
  constexpr std::array<Rgb, 3> of_axis{colours::axis_x, colours::axis_y, colours::axis_z};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d end = origin + length_m * directions.col(k);
    const Eigen::Vector2d from = axes.at(view(origin)), to = axes.at(view(end));
    axes.canvas().arrow(from, to, of_axis[k], width_px);
    const Eigen::Vector2d along =
        (to - from).norm() > 1 ? (to - from).normalized() : Eigen::Vector2d(0, -1);
    axes.canvas().text(to + 12 * along, names[k],
                       {.height_px = 10,
                        .colour = of_axis[k],
                        .anchor = along.x() > 0.3    ? TextAnchor::left
                                  : along.x() < -0.3 ? TextAnchor::right
                                                     : TextAnchor::centre,
                        .halo = true});
  }
}

}  // namespace alea
