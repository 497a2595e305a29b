#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/die/conjugate_points.hpp"
#include "alea/die/hand.hpp"
#include "alea/die/orthogonal_axes.hpp"

namespace alea {

struct PaperRegistrationOptions {
  DieDimensions dimensions;
  FrameRule rule = FrameRule::fix_z;  ///< which axis stays; the paper shows Z
  PrintedErrors errors;               ///< PrintedErrors::as_printed() for the printed equations
  std::optional<int> up_pips;         ///< the upper facet; empty: the one that points up the most
  HandRule hand = HandRule::clockwise;
};

struct PaperRegistration {
  RigidTransform master_from_slave;
  CornerFrame master_frame;  ///< before orthogonalisation
  CornerFrame slave_frame;
  OrthogonalFrame v;  ///< the master's frame after it
  OrthogonalFrame u;  ///< the slave's
  ConjugatePoints points;
  RigidTransform v_from_u;
  /// Derivatives of the translation (m/m, in the master's frame) by the lengths from 1 to 6, 2 to
  /// 5, 3 to 4 and the lift: what a calibration moves. The rotation does not depend on them.
  Eigen::Matrix<double, 3, 4> translation_by_dimensions = Eigen::Matrix<double, 3, 4>::Zero();
  std::vector<int> shared;  ///< pips seen in both scans, ascending
};

/// Equations (1) to (8) of Chan et al. 2023 (section 2.3): frames at two corners, three pairs of
/// conjugate points, Horn's method. Any pair of corners; the paper's own covariance is none, so
/// there is none here. Refusals: `mirrored`, `chirality`, `dihedral`; `unobservable` where an upper
/// facet is asked for that one of the scans does not see.
Result<PaperRegistration> register_paper(const ObservedDie& master, const ObservedDie& slave,
                                         const PaperRegistrationOptions& options);

}  // namespace alea
