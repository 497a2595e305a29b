#pragma once

#include <Eigen/Core>
#include <vector>

#include "alea/core/rigid_transform.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// RMS 3-D displacement (m) that the covariance of a transform gives a point (m), in the frame that
/// the transform maps to.
double point_error_m(const TransformCovariance& covariance, const Eigen::Vector3d& point_m);

/// A horizontal rectangle of the scene, cut into square cells. Scene frame, metres.
struct MapArea {
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_m = Eigen::Vector2d::Ones();
  double height_m = 1.5;
  double cell_m = 0.25;  ///< the last row and column may stand out over `high_m`

  int columns() const;
  int rows() const;
  /// Centre of a cell.
  Eigen::Vector3d at(int column, int row) const;
};

/// The rectangle that holds the scene's patches (a room's walls), else everything in it and 2 m
/// more on each side; with at most 200 cells a side, so that the cells may come out larger than
/// asked for.
MapArea area_of(const Scene& scene, double height_m = 1.5, double cell_m = 0.25);

/// Predicted error of a transformed point, cell by cell.
struct ErrorMap {
  MapArea area;
  std::vector<double> error_m;  ///< RMS 3-D displacement, row by row from low_m

  double at(int column, int row) const { return error_m[row * area.columns() + column]; }
  double root_mean_square_m() const;
  double largest_m() const;
  /// Share of the cells whose error is at most the tolerance.
  double share_within(double tolerance_m) const;
};

/// The covariance is that of master_from_slave, in the master's frame.
ErrorMap error_map(const TransformCovariance& covariance, const RigidTransform& master_from_scene,
                   const MapArea& area);

}  // namespace alea
