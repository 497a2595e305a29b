#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "alea/core/rigid_transform.hpp"

namespace alea {

/// The 6 x 6 blocks on the diagonal of the inverse of a positive definite matrix made of such
/// blocks, which must be full on its diagonal. Only those entries of the inverse are computed in
/// which the Cholesky factor is not zero: Takahashi, Fagan, Chin 1973, Formation of a sparse bus
/// impedance matrix (Erisman, Tinney 1975, doi 10.1145/360680.360704).
std::vector<Matrix6d> inverse_diagonal_blocks(const Eigen::SparseMatrix<double>& matrix);

}  // namespace alea
