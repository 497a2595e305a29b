#include "alea/checkerboard/fitted_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace alea {
namespace {

/// In-plane covariance, and that of the plane's offset along the ray through the centre.
Eigen::Matrix3d centre_covariance(const FittedBoard& fitted, const BoardFit::Covariance& in_plane,
                                  const Eigen::Matrix3d& of_plane) {
  const BoardPlane& plane = fitted.plane;
  const Eigen::Vector2d at = fitted.fit.pose.centre_m;
  const Eigen::Vector3d lever(at.x(), at.y(), -1);
  const double offset_variance = lever.dot(of_plane * lever);
  const Eigen::Vector3d centre = plane.anchor + plane.axes * at;
  Eigen::Vector3d along = plane.plane.normal;
  if (!fitted.points.rays.empty()) {
    const Eigen::Vector3d scanner_to_centre = fitted.points.rays[0];
    // The rays of a target are nearly parallel: the one nearest to the centre stands for it.
    Eigen::Vector3d ray = scanner_to_centre;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < fitted.points.size(); ++i) {
      const double off = (fitted.points.positions[i] - centre).squaredNorm();
      if (off < nearest) {
        nearest = off;
        ray = fitted.points.rays[i];
      }
    }
    along = ray / std::abs(ray.dot(plane.plane.normal));
  }
  return plane.axes * in_plane.topLeftCorner<2, 2>() * plane.axes.transpose() +
         offset_variance * along * along.transpose();
}

/// The axes of the board, rows upward, and what else looks the same.
void add_axes(const FittedBoard& fitted, const BoardSpec& board, BoardMeasurement& result) {
  const double angle = fitted.fit.pose.angle_rad;
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const BoardAxes first = fitted.plane.axes * turn;
  std::vector<BoardAxes> same{first};
  if (board.half_turn_symmetric()) same.push_back(-first);
  if (board.quarter_turn_symmetric()) {
    BoardAxes quarter;
    quarter << first.col(1), -first.col(0);
    same.push_back(quarter);
    same.push_back(-quarter);
  }
  const auto upward = [](const BoardAxes& axes) {
    return std::tuple(axes(2, 1), axes(1, 1), axes(0, 1));
  };
  std::stable_sort(same.begin(), same.end(),
                   [&](const BoardAxes& a, const BoardAxes& b) { return upward(a) > upward(b); });
  result.axes = same[0];
  result.alternatives.assign(same.begin() + 1, same.end());
  if (!result.alternatives.empty())
    result.warnings.push_back(
        fmt::format("symmetric: the pattern looks the same after a {} turn; the centre does not "
                    "depend on it",
                    board.quarter_turn_symmetric() ? "quarter" : "half"));
}

}  // namespace

BoardMeasurement described(const FittedBoard& fitted, const BoardSpec& board) {
  const BoardPlane& plane = fitted.plane;
  const BoardFit& fit = fitted.fit;
  BoardMeasurement result;
  result.centre_m = fitted.points.origin + plane.anchor + plane.axes * fit.pose.centre_m;
  result.covariance = centre_covariance(fitted, fit.covariance, plane.covariance);
  result.bound = centre_covariance(fitted, fit.bound, plane.bound);
  result.normal = plane.plane.normal;
  result.cell_m = fit.cell_m;
  result.cell_estimated = board.columns > 2;
  result.rmse_m = plane.rmse_m;
  result.correlation =
      correlate(board, fitted.places, fitted.points.intensity, fit.pose).correlation;
  result.dark = fit.dark();
  result.light = fit.light();
  result.blur_m = fit.blur_m;
  result.points = fit.points;
  add_axes(fitted, board, result);
  const int along = std::max(20, 4 * board.columns);
  const double gate_m = 1.5 * std::max(board.side_m() / along, fitted.spacing_m);
  Cloud flat;
  const OnBoard on_board(fit.pose);
  for (std::size_t i = 0; i < fitted.places.size(); ++i) {
    const Eigen::Vector2d at = on_board(fitted.places[i]);
    if (!in_outline(board, at, -gate_m)) continue;
    flat.positions.emplace_back(at.x(), at.y(), 0);
    flat.intensity.push_back(fitted.points.intensity[i]);
  }
  result.colour_score = colour_score(board_template(board, along), flat, fit.mean, gate_m);
  return result;
}

}  // namespace alea
