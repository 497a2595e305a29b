#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

/// How far a scanner saw in each direction: the least range (m) in each cell of a grid of azimuth
/// and elevation about it and in the eight cells around that one, so that outlines and thin objects
/// that fall between the beams count as seen. Up to that range the space is free.
class RangeImage {
 public:
  /// `origin_m`: the scanner, in the frame of the points; `cell_rad`: of the grid.
  RangeImage(const Cloud& cloud, const Eigen::Vector3d& origin_m, double cell_rad);

  /// Free range (m) in the direction of a place; empty where nothing was measured.
  std::optional<double> free_range_m(const Eigen::Vector3d& place_m) const;
  /// Is the place nearer than the free range by more than `margin_m`? Then a surface there would
  /// have stopped the beams that went through: Free-space violation, Huber and Hebert 2003, Fully
  /// automatic registration of multiple 3D data sets, Image Vis. Comput. 21(7).
  bool is_in_free_space(const Eigen::Vector3d& place_m, double margin_m) const;

 private:
  void widen_near_surfaces();
  std::size_t cell_of(const Eigen::Vector3d& from_scanner) const;

  Eigen::Vector3d origin_m_;
  double cell_rad_;
  std::size_t columns_, rows_;
  std::vector<float> nearest_m_;
};

}  // namespace alea
