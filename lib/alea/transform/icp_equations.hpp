#pragma once

#include "alea/transform/icp_pairs.hpp"

namespace alea {

/// Gauss-Newton sums of one term over the pairs: a left perturbation (rotation, translation) about
/// the mean of the moved points.
struct IcpSums {
  Matrix6d normal_matrix = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double squares = 0;  ///< weighted
};

struct IcpSystem {
  Eigen::Vector3d about = Eigen::Vector3d::Zero();  ///< mean of the moved points of the pairs
  double radius_m = 0;                              ///< their root mean square distance from it
  double distance_squares = 0;                      ///< of the pairs, unweighted
  IcpSums geometric, photometric;
  double gain = 1, offset = 0;
  double geometric_weight = 1, photometric_weight = 0;

  Matrix6d normal_matrix() const;
  Vector6d gradient() const;
};

/// The sums in fixed order: chunks of pairs, added one after the other.
IcpSystem icp_system(const IcpTarget::Data& target, const IcpPoints& source, const IcpPairs& pairs,
                     const IcpOptions& options);

/// The step -H^-1 g in the directions that the system determines.
struct IcpStep {
  Vector6d delta = Vector6d::Zero();  ///< rotation (rad), translation (m), about `about`
  int determined = 0;
};
IcpStep solve(const IcpSystem& system, double null_space_share);

/// Horn's closed form for the pairs, with the kernel's weights.
RigidTransform closed_form_step(const IcpTarget::Data& target, const IcpPairs& pairs,
                                const IcpOptions& options);

}  // namespace alea
