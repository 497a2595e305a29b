#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/fisher_scene.hpp"

namespace alea {

/// Cramer-Rao bound of a scene seen from several stations: no unbiased estimator that knows no more
/// than FisherScene says has a smaller covariance.
struct FisherBound {
  /// Directions that the observations leave open beyond the six freedoms of the common frame (and
  /// beyond nothing where priors fix that frame): lengths, headings.
  int defect = 0;
  /// Over the stations alone, six each: rotation x, y, z (rad), translation x, y, z (m), the left
  /// perturbation of scene_from_scan about `about_m`, in the scene frame. The pseudo-inverse: only
  /// differences between stations have a meaning, and only those orthogonal to `open`.
  Eigen::MatrixXd station_covariance;
  /// Columns: the station part of the directions without information (common motions included).
  Eigen::MatrixXd open;
  Eigen::VectorXd unit;  ///< standard deviation of each station parameter, all else being known
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();  ///< scene frame: the mean of the targets
  std::vector<RigidTransform> scene_from_scan;
};

/// The Fisher information of all rays, with the shapes and radii as nuisance parameters.
/// Rank decisions come from the spectrum of the normal matrix scaled to a unit diagonal.
/// Throws a usage error without two stations or without a target.
FisherBound fisher_bound(const FisherScene& scene);

/// Covariance of master_from_slave, left perturbation in the master frame, about the image there
/// of `about_scene_m`. Refuses as `unobservable` where the data leave it open.
Result<TransformCovariance> relative_covariance(const FisherBound& bound, std::size_t master,
                                                std::size_t slave,
                                                const Eigen::Vector3d& about_scene_m);

/// A covariance in three numbers of the die study, section 5.
struct PoseAccuracy {
  double rotation_rad = 0;   ///< root of the summed variances about three axes
  double translation_m = 0;  ///< the same of the displacement at the point itself
  double ring5_m = 0;        ///< RMS 3-D displacement on a horizontal ring of 5 m about the point
  double ring10_m = 0;       ///< and of 10 m
};

/// `up` is the axis of the ring in the frame of the covariance.
PoseAccuracy pose_accuracy(const TransformCovariance& covariance,
                           const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

/// RMS 3-D displacement (m) on a circle of `radius_m` about the covariance's point, at right angles
/// to `up`.
double ring_error_m(const TransformCovariance& covariance, double radius_m,
                    const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

/// Bound of a cube of `edge_m` on the floor seen by two stations at `range_m` from its centre,
/// 45 deg off the facets, `separation_rad` apart, scanner 1.6 m above the floor: the geometry of
/// the die study. `shape_known`: bound K; else L, all tilts and offsets free and the shared edge
/// exact.
struct DieBoundCase {
  double edge_m = 0.5;
  double range_m = 6;  ///< from the scanner to the die's centre, along the line of sight
  double step_rad = 3e-4;
  double separation_rad = 1.5707963267948966;
  double scanner_height_m = 1.6;
  bool shape_known = true;
  NoiseModel noise;
};
FisherScene die_bound_scene(const DieBoundCase& geometry);
PoseAccuracy die_bound(const DieBoundCase& geometry);

}  // namespace alea
