#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "alea/evaluate/noise_tiles.hpp"

namespace alea {

/// A linear model of the tiles' variances: theta . (cos2, range2_cos2, sin2, range2_sin2) + known.
struct NoiseRegression {
  Eigen::Vector4d theta = Eigen::Vector4d::Zero();  ///< not negative
  /// Standard errors of the free thetas, overdispersion included; infinite (or beyond all measure)
  /// where they cannot be told apart.
  Eigen::Vector4d standard_error = Eigen::Vector4d::Zero();
  std::vector<bool> used;     ///< tiles that are like the others
  double overdispersion = 1;  ///< of their variances over chance
  /// For each theta the standard error's share of the whole variance where the term matters most:
  /// range terms at normal incidence, the others at 60 deg; at the median range of the tiles, those
  /// that grow with it at the 95th percentile.
  Eigen::Vector4d share = Eigen::Vector4d::Zero();
};

/// Weighted least squares with weights freedoms / (2 expected^2), iterated; tiles beyond four
/// robust standard deviations on the cube-root scale left out. `fixed`: thetas that are known.
NoiseRegression regress_noise(const std::vector<NoiseTile>& tiles,
                              const std::array<std::optional<double>, 4>& fixed,
                              double known_variance_m2);

}  // namespace alea
