#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"

namespace alea {

/// What ICP minimises over the pairs of each iteration.
enum class IcpObjective {
  point_to_point,  ///< Besl and McKay 1992, doi 10.1109/34.121791, by Horn's closed form
  point_to_plane,  ///< Chen and Medioni 1992, doi 10.1016/0262-8856(92)90066-C
  coloured         ///< Park, Zhou, Koltun 2017, doi 10.1109/ICCV.2017.25
};

/// How the two terms of coloured ICP are weighed.
enum class ColourWeighting {
  published,        ///< lambda on the geometric and 1 - lambda on the photometric term
  inverse_variance  ///< each term over the variance of its own residuals, at every iteration
};

/// Weights from residuals over their own robust scale (1.4826 times the median absolute one).
enum class RobustKernel { none, huber, tukey };

struct IcpOptions {
  IcpObjective objective = IcpObjective::point_to_plane;
  /// A point whose nearest target point lies further away makes no pair.
  double max_distance_m = std::numeric_limits<double>::infinity();
  int max_iterations = 50;
  double rotation_tolerance_rad = 1e-7;  ///< a step below both of these ends it
  double translation_tolerance_m = 1e-7;
  /// As do changes of fitness and of rmse, relative to itself, below this.
  double settled_change = 1e-6;
  double trim_share = 0;  ///< of the pairs, those with the largest distances; in [0, 1)
  RobustKernel kernel = RobustKernel::none;
  /// Largest angle between the normals of a pair, sign ignored; below pi/2 both clouds need them.
  double normal_angle_rad = std::numeric_limits<double>::infinity();
  /// Normals count with their sign: those of both clouds face their scanners, and the two faces of
  /// a thin wall do not pair.
  bool oriented_normals = false;
  /// Directions in which the normal matrix is below this share of its largest eigenvalue are not
  /// determined by the data and stay as they are: on a plane, sliding and turning in it. Rotations
  /// count in units of the pairs' radius about their centroid, so the share has no unit.
  double null_space_share = 1e-9;

  // Coloured only.
  double lambda = 0.968;  ///< of the geometric term, as published
  ColourWeighting weighting = ColourWeighting::published;
  /// Offset and gain of the source's intensities, so that those of the pairs have the mean and the
  /// standard deviation of the target's. Park et al. have neither.
  bool match_intensity = false;
  std::size_t gradient_neighbours = 30;  ///< the point and those as far as the last one included
  double gradient_radius_m = 0;          ///< 0: twice max_distance_m
};

enum class IcpStop {
  step_small,        ///< the last step was below both tolerances
  residual_settled,  ///< fitness and rmse no longer change
  iteration_limit,
  too_few_pairs,  ///< fewer than three (point_to_point) or six
  undetermined    ///< no direction of motion is determined by the pairs
};
const char* to_string(IcpStop stop);

struct IcpResult {
  RigidTransform target_from_source;
  double rmse_m = 0;          ///< root mean square distance between the points of the pairs
  double fitness = 0;         ///< pairs over source points
  double normal_rmse_m = 0;   ///< the same along the target's normals; 0 for point_to_point
  double intensity_rmse = 0;  ///< of the photometric term; 0 unless coloured
  std::size_t pairs = 0;      ///< after trimming and the test of the normals
  int iterations = 0;         ///< steps taken
  int determined = 0;         ///< directions of motion, of six, that the pairs determine
  IcpStop stop = IcpStop::iteration_limit;
  bool converged() const {
    return stop == IcpStop::step_small || stop == IcpStop::residual_settled;
  }
  /// Normal matrix of the last pairs over the variance of their residuals: the inverse of the
  /// covariance of the left perturbation (rotation, translation) about `information_about_m` in the
  /// target's frame, where the pairs are right and their residuals independent.
  Matrix6d information = Matrix6d::Zero();
  Eigen::Vector3d information_about_m = Eigen::Vector3d::Zero();  ///< mean of the pairs
  double gain = 1, offset = 0;  ///< of the source's intensities, where they are matched
};

/// A target made ready: search tree, normals and, where it has intensities or colours and the
/// options ask for them, their gradients on the tangent planes. For repeated use.
class IcpTarget {
 public:
  /// Throws Error(usage) for an option out of range, an empty cloud, or one without the normals or
  /// intensities that the objective needs.
  IcpTarget(const Cloud& target, const IcpOptions& options);
  ~IcpTarget();
  IcpTarget(IcpTarget&&) noexcept;
  IcpTarget& operator=(IcpTarget&&) noexcept;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<const Data> data_;
};

/// Moves the source onto the target from a start, `target_from_source`. The same bits for any
/// thread count and any order of the points. Throws Error(usage) where an array is missing or the
/// source is empty. `options` must name the objective and radii that the target was made for.
IcpResult icp(const IcpTarget& target, const Cloud& source, const RigidTransform& start,
              const IcpOptions& options);

/// The same for one-off use.
IcpResult icp(const Cloud& target, const Cloud& source, const RigidTransform& start,
              const IcpOptions& options);

}  // namespace alea
