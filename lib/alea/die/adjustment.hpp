#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/die/adjustment_quality.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/observed_die.hpp"
#include "alea/die/shape_prior.hpp"

namespace alea {

/// A plane of the scene as one scan saw it. The same id means the same plane in other scans.
struct ScenePlane {
  int id = 0;
  PlaneFit fit;  ///< scan frame
};

/// What one scan brings to the adjustment. The planes' fits stand for their points: a fit along the
/// ray has condensed them into the three normal equations of its plane, with Jacobians at predicted
/// points, and the sum of squares is quadratic in the plane far beyond its standard deviations.
struct AdjustmentScan {
  ObservedDie die;
  std::vector<ScenePlane> planes;
};

/// A length from corner to corner that is known beforehand.
struct KnownEdge {
  EdgeName edge;
  double length_m = 0;
  double sd_m = 0;  ///< zero: exact
};

struct AdjustmentOptions {
  ShapePrior shape;
  std::vector<KnownEdge> edges;  ///< those with a facet that no scan sees say nothing
  /// Levelled scanners: standard deviation of each scan's z axis from the vertical, in two
  /// directions (rad).
  std::optional<double> level_sd_rad;
  HandRule hand = HandRule::clockwise;
  /// Chance of a false alarm of the facet tests, all facets together.
  double alarm_level = 0.001;
  /// Point in the first scan's frame that covariances refer to; empty: as in ClosedFormOptions.
  std::optional<Eigen::Vector3d> covariance_about_m;
};

struct AdjustedPose {
  RigidTransform master_from_scan;  ///< the master is the first scan
  TransformCovariance covariance;   ///< left perturbation in the master frame
  bool determined = true;           ///< false: some direction of it is open
};

/// An edge of the die, corner to corner; numbers only where it is determined.
struct AdjustedEdge {
  EdgeName edge;
  std::optional<double> length_m;
  std::optional<double> sd_m;
};

/// The angle inside the die between two facets that meet; numbers only where it is determined.
struct AdjustedAngle {
  EdgeName edge;
  std::optional<double> angle_rad;
  std::optional<double> sd_rad;
};

struct DieAdjustment {
  std::vector<AdjustedPose> poses;  ///< one for each scan; the first is the identity
  RigidTransform master_from_die;
  DieShape shape;  ///< die frame: origin in the middle; facets that a scan saw
  /// Of the shape's departures about `shape`, without the die's motion as a whole (inner
  /// constraints) and without what is open: zero in those directions and for unseen facets.
  ShapeMatrix shape_covariance = ShapeMatrix::Zero();
  /// Along 1-6, 2-5, 3-4: whether the distance between the two facets is determined.
  std::array<bool, 3> length_determined{};
  std::vector<AdjustedEdge> edges;    ///< those of which all four facets were seen
  std::vector<AdjustedAngle> angles;  ///< of all pairs of facets that were seen
  int defect = 0;                     ///< directions that the observations leave open
  std::vector<std::string> open;      ///< the same in words, one for each
  double chi_square = 0;
  int freedom = 0;
  double p_value = 1;
  /// All covariances are already multiplied by it: 1, or chi_square / freedom where the global test
  /// fails at 0.1 %.
  double covariance_factor = 1;
  std::vector<VarianceComponent> components;
  std::vector<FacetTest> tests;  ///< facets, then planes of the scene
  int iterations = 0;
};

/// Weighted least squares of all facets of one die in any number of scans. Unknowns: the pose of
/// each scan but the first, the die's pose, the departures of its facets that are not exact, scene
/// planes. Jacobians are taken at predicted planes, so that what cannot be seen stays unseen under
/// noise; what is open is left at its start, said in `open` and marked in the results.
/// Refusals: `mirrored`, `chirality`, `dihedral` of any scan against the first; `no_convergence`.
/// Throws Error(usage) for fewer than one scan or a mixture of exact and noisy facets.
Result<DieAdjustment> adjust_die(const std::vector<AdjustmentScan>& scans,
                                 const AdjustmentOptions& options);

}  // namespace alea
