#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/plane.hpp"

namespace alea {

/// The points of a scan that may belong to a target, with the directions in which they were
/// measured.
struct BoardPoints {
  std::vector<Eigen::Vector3d> positions;  ///< m, about `origin`
  std::vector<Eigen::Vector3d> rays;       ///< unit, from the scanner; empty where it is unknown
  std::vector<float> intensity;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the positions, in the scan's frame
  std::size_t size() const { return positions.size(); }
};

/// The points within a radius (m) of a place in the scan's frame, in spatial order.
BoardPoints board_points(const Cloud& cloud, const Eigen::Vector3d& near_m, double radius_m,
                         const std::optional<Eigen::Vector3d>& scanner_position);

/// Those of `points` at the places in `indices`.
BoardPoints subset(const BoardPoints& points, const std::vector<std::uint32_t>& indices);

/// A plane fitted to the members along their rays (along the normal where the scanner is unknown),
/// with Tukey's weights and a scale of its own for each class.
struct BoardPlane {
  Plane plane;  ///< towards the scanner; about the points' origin
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< on the plane; origin of its coordinates
  Eigen::Matrix<double, 3, 2> axes;                  ///< e1, e2 with [e1 e2 normal] right-handed
  std::array<double, 2> range_sd_m{};                ///< along the ray, of dark and light points
  /// Of a (rad), b (rad), c (m): normal + a e1 + b e2 about the anchor, then shifted by c. From the
  /// residuals themselves, and the least that such scales allow.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero(), bound = Eigen::Matrix3d::Zero();
  double rmse_m = 0;  ///< along the normal, of the points that Tukey's weights keep
};

/// `is_light`: the class of each point. `start` must be near.
BoardPlane fit_board_plane(const BoardPoints& points, const std::vector<std::uint8_t>& is_light,
                           const Plane& start);

/// Where each point's ray cuts the plane (its foot where the scanner is unknown), in (e1, e2) from
/// the anchor.
std::vector<Eigen::Vector2d> places_on(const BoardPlane& plane, const BoardPoints& points);

}  // namespace alea
