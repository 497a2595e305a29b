#include "alea/markerless/selected_inverse.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace alea {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The lower triangle of (L D L')^-1 where the unit lower L is not zero, from the last column on:
/// Z_ij = [i = j] / D_j - sum over k > j of L_kj Z_ik.
Sparse inverse_on_pattern(const Sparse& lower, const Eigen::VectorXd& diagonal) {
  const Eigen::Index n = lower.cols();
  std::vector<Eigen::Triplet<double>> pattern;
  for (Eigen::Index j = 0; j < n; ++j) {
    pattern.emplace_back(static_cast<int>(j), static_cast<int>(j), 0.0);
    for (Sparse::InnerIterator it(lower, j); it; ++it)
      if (it.row() > j) pattern.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), 0.0);
  }
  Sparse inverse(n, n);
  inverse.setFromTriplets(pattern.begin(), pattern.end());
  Eigen::VectorXd factor = Eigen::VectorXd::Zero(n), column = Eigen::VectorXd::Zero(n);
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    for (Sparse::InnerIterator it(lower, j); it; ++it)
      if (it.row() > j) factor[it.row()] = it.value();
    for (Sparse::InnerIterator at(inverse, j); at; ++at) {
      const Eigen::Index k = at.row();
      if (k == j) continue;
      for (Sparse::InnerIterator z(inverse, k); z; ++z) {
        column[z.row()] -= factor[k] * z.value();
        if (z.row() != k) column[k] -= factor[z.row()] * z.value();
      }
    }
    double own = 1 / diagonal[j];
    for (Sparse::InnerIterator at(inverse, j); at; ++at)
      if (at.row() != j) own -= factor[at.row()] * column[at.row()];
    for (Sparse::InnerIterator at(inverse, j); at; ++at)
      at.valueRef() = at.row() == j ? own : column[at.row()];
    for (Sparse::InnerIterator at(inverse, j); at; ++at) {
      factor[at.row()] = 0;
      if (at.row() == j) continue;
      for (Sparse::InnerIterator z(inverse, at.row()); z; ++z) column[z.row()] = 0;
    }
  }
  return inverse;
}

}  // namespace

std::vector<Matrix6d> inverse_diagonal_blocks(const Sparse& matrix) {
  const Eigen::SimplicialLDLT<Sparse> solver(matrix);
  const Sparse lower = solver.matrixL();
  const Sparse inverse = inverse_on_pattern(lower, solver.vectorD());
  const auto& place = solver.permutationP().indices();
  std::vector<Matrix6d> blocks(static_cast<std::size_t>(matrix.cols() / 6));
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) {
        const auto at = static_cast<Eigen::Index>(6 * b);
        const int i = place[at + r], k = place[at + c];
        blocks[b](r, c) = inverse.coeff(std::max(i, k), std::min(i, k));
      }
  return blocks;
}

}  // namespace alea
