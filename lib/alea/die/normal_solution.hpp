#pragma once

#include <Eigen/Core>

namespace alea {

/// Minimise x'Nx/2 - b'x with C x = d.
struct NormalSystem {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  Eigen::MatrixXd constraints;  ///< rows; may be empty
  Eigen::VectorXd closure;
};

/// Of several solutions the shortest one, in units of what each unknown's standard deviation would
/// be if all others were known.
struct NormalSolution {
  Eigen::VectorXd correction;
  /// Pseudo-inverse: true for every combination of unknowns that `open` does not change.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd open;  ///< columns: directions without information that keep the constraints
  Eigen::VectorXd unit;  ///< those standard deviations
  int rank = 0;          ///< directions with information
};

/// Rank by the spectrum of the normal matrix scaled to a unit diagonal, on the kernel of the
/// constraints: eigenvalues below 1e-11 of the largest count as zero. Rounding leaves 1e-15; the
/// weakest real geometry of the die, and priors 1e3 times weaker than the data, stay above 1e-8.
NormalSolution solve_normal(const NormalSystem& system);

/// Whether a combination of unknowns is determined: it does not change along an open direction.
bool is_determined(const NormalSolution& solution, const Eigen::RowVectorXd& combination);

}  // namespace alea
