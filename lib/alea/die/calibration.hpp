#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/facet/plane_fit.hpp"

namespace alea {

/// One plane of the scene in both scans, each in its scan's own frame.
struct PlanePair {
  PlaneFit master;
  PlaneFit slave;
};

/// master_from_slave as a function of lengths of the die: the rotation does not depend on them, the
/// translation does so linearly.
struct LengthModel {
  RigidTransform master_from_slave;  ///< at `lengths_m`
  /// Of master_from_slave at fixed lengths; without it the planes' own noise alone is propagated.
  std::optional<TransformCovariance> covariance;
  Eigen::VectorXd lengths_m;  ///< k initial values
  /// 3 x k, master frame: derivative of the translation by each length. For a shared edge one unit
  /// column, the edge's direction.
  Eigen::MatrixXd directions;
};

/// The model's transform at other lengths.
RigidTransform at_lengths(const LengthModel& model, const Eigen::VectorXd& lengths_m);

struct CalibrationOptions {
  /// A length is observable where some plane's normal has at least this cosine with its direction
  /// and no other length does the same to all planes.
  double min_sensitivity = 0.1;
};

struct LengthCalibration {
  Eigen::VectorXd lengths_m;   ///< unobservable ones keep their initial value
  Eigen::MatrixXd covariance;  ///< k x k (m^2); infinite variance where unobservable
  std::vector<bool> observable;
  /// pairs x k: n . e, how much a plane's offset changes with each length.
  Eigen::MatrixXd sensitivity;
  Eigen::VectorXd offsets_m;         ///< slave minus master at each plane, after the calibration
  double variance_factor = 1;        ///< squared offsets over what planes and transform expect
  int redundancy = 0;                ///< pairs minus observable lengths
  RigidTransform master_from_slave;  ///< at lengths_m
};

/// The lengths that make the planes of both scans coincide: generalised least squares on the
/// planes' offsets at the slave's centroids, linear and so done in one step, weighted by the
/// planes' covariances and, where given, that of the transform (its rotation moves far planes
/// together). The covariance is not scaled by the variance factor. Refusal unobservable where no
/// plane says anything about any length; Throws Error(usage) for inconsistent sizes.
Result<LengthCalibration> calibrate_lengths(const std::vector<PlanePair>& pairs,
                                            const LengthModel& model,
                                            const CalibrationOptions& options = {});

/// RMS offset (m) of the pairs under a transform, slave minus master at the slave's centroids.
double rms_offset_m(const std::vector<PlanePair>& pairs, const RigidTransform& master_from_slave);

/// The minimum that golden section found.
struct GoldenSection {
  double argument = 0;
  double value = 0;
  int evaluations = 0;
  /// Objective at the worse end of the interval over that at the minimum, minus 1: near zero where
  /// the objective does not depend on the argument, and then `argument` means nothing.
  double rise = 0;
  bool at_border = false;  ///< the minimum lies within the tolerance of an end of the interval
};

/// Golden section search for the minimum of a unimodal function on [low, high] until the interval
/// is shorter than `tolerance`: the published way to the length (die paper, equation 9). Throws
/// Error(usage) unless low < high and tolerance > 0.
GoldenSection golden_section(const std::function<double(double)>& objective, double low,
                             double high, double tolerance);

}  // namespace alea
