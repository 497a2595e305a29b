#pragma once

#include <Eigen/Core>

#include "alea/evaluate/fisher_scene.hpp"

namespace alea {

/// The normal equations of a FisherScene. Parameters in this order: six for each station; for each
/// body six for its place, then tilt, tilt, offset of each facet as far as they are free and the
/// facet is seen; for each sphere its centre and, if unknown, its radius. All rotations are about
/// `about_m`, in the scene frame.
struct FisherNormal {
  Eigen::MatrixXd normal;       ///< information, priors included
  Eigen::MatrixXd constraints;  ///< rows: exactly known lengths
  Eigen::MatrixXd world;        ///< columns: the six motions of everything together
  /// Parameters that exist twice: motions of a body that its free facets can make as well, or that
  /// nobody could see.
  int redundant = 0;
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();
};

FisherNormal fisher_normal(const FisherScene& scene);

}  // namespace alea
