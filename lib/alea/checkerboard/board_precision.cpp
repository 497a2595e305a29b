#include "alea/checkerboard/board_precision.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace alea {
namespace {

using Matrix = BoardFit::Covariance;

/// Inverse over the parameters in `which`, zero for the others.
Matrix inverse_over(const std::vector<int>& which, const Matrix& matrix) {
  const Eigen::MatrixXd part = matrix(which, which);
  const auto n = static_cast<Eigen::Index>(which.size());
  const Eigen::MatrixXd solved = part.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  Matrix inverse = Matrix::Zero();
  inverse(which, which) = solved;
  return inverse;
}

}  // namespace

void add_precision(const BoardExpectation& expectation, std::span<const BoardSample> samples,
                   const std::vector<int>& which, BoardFit& fit) {
  struct Residual {
    BoardRow row;
    double variance, standardised;
  };
  std::vector<Residual> residuals;
  residuals.reserve(samples.size());
  Matrix fisher = Matrix::Zero(), scatter = Matrix::Zero();
  double kept = 0;
  for (const BoardSample& sample : samples) {
    const ExpectedIntensity model = expectation.at(expectation.on_board(sample.place));
    const double v = intensity_variance(fit, model);
    const double off = (sample.intensity - model.value) / std::sqrt(v);
    residuals.push_back({model.row, v, off});
    fisher.noalias() += (model.row / v) * model.row.transpose();
    kept += std::abs(off) <= board_huber;
  }
  // The mean of psi' stands for each: a matrix of the few points that are kept may be singular.
  const double slope =
      std::max(kept, 1.0) / static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  const Matrix inverse = inverse_over(which, slope * fisher);
  for (const Residual& one : residuals) {
    const double leverage = one.row.dot(inverse * one.row) / one.variance;
    const double psi = std::clamp(one.standardised, -board_huber, board_huber);
    const double squared = psi * psi / (one.variance * std::max(1 - leverage, 0.1));
    scatter.noalias() += (squared * one.row) * one.row.transpose();
  }
  fit.covariance = inverse * scatter * inverse;
  fit.bound = inverse_over(which, fisher);
}

}  // namespace alea
