#pragma once

#include <array>
#include <optional>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/hand.hpp"
#include "alea/die/observed_die.hpp"

namespace alea {

struct ClosedFormOptions {
  /// Length from corner to corner of the edge between the two shared facets. With a tilt prior it
  /// stands for the distance between opposite facets.
  std::optional<double> edge_m;
  double edge_sd_m = 0;           ///< standard deviation of edge_m; zero: exact
  std::optional<DieShape> shape;  ///< a calibrated die: all facets of both scans are used
  /// Standard deviation of each facet's two tilts off a cube of edge_m. Only used where fewer than
  /// two facets are shared and no shape is given; the covariance carries it.
  std::optional<double> tilt_prior_rad;
  HandRule hand = HandRule::clockwise;
  /// Point in the master frame that the covariance refers to; empty: the master frame's origin
  /// where it lies within 1 km of the die, else the die's centre.
  std::optional<Eigen::Vector3d> covariance_about_m;
};

/// The edge where two facets meet, named by their pips, first < second.
struct EdgeName {
  int first_pips = 0;
  int second_pips = 0;
};

struct DieRegistration {
  RigidTransform master_from_slave;
  TransformCovariance covariance;  ///< left perturbation in the master frame
  Chirality hand = Chirality::clockwise;
  std::vector<int> shared;  ///< pips seen in both scans, ascending
  /// Two shared facets: their edge. Three: the edge whose direction is known best. Else empty.
  std::optional<EdgeName> shared_edge;
  /// The length of shared_edge that the result rests on; empty where it rests on none.
  std::optional<double> edge_m;
  /// Derivative of the translation (m/m, master frame) by that length: the unit direction of the
  /// edge; the rotation does not depend on it. Zero where no length is used.
  Eigen::Vector3d translation_by_edge = Eigen::Vector3d::Zero();
  Eigen::Vector3d corner_master_m = Eigen::Vector3d::Zero();  ///< master frame
  Eigen::Vector3d corner_slave_m = Eigen::Vector3d::Zero();   ///< slave frame
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of the die, near enough; master frame
  /// How far the scans disagree about the shape that both see: chi-square and its degrees of
  /// freedom (three shared facets 3, two 1, a known shape 6).
  double misclosure_chi_square = 0;
  int misclosure_freedom = 0;
};

/// Registers two scans by the facets of one die, with the covariance propagated from the planes.
/// Three shared facets: directly. Two: their edge and both normals, weighted by the covariances of
/// the planes, and along the edge by its length; what the die's other angles are does not matter.
/// One or none: by a known shape, or by a cube with a tilt prior. A known shape is used with any
/// number. Refusals: `mirrored`, `chirality`, `dihedral`; `one_shared_facet`; `unobservable` for
/// two shared facets without a length. Throws Error(usage) for lengths or deviations that are not
/// positive and for labels that do not meet at a corner.
Result<DieRegistration> register_closed_form(const ObservedDie& master, const ObservedDie& slave,
                                             const ClosedFormOptions& options);

}  // namespace alea
