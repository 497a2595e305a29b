#include "alea/die/normal_solution.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

namespace alea {
namespace {

constexpr double rank_tolerance = 1e-11;
constexpr double leak_tolerance = 1e-5;  // of a combination's own unit

/// The solutions of C y = d: a particular one and an orthonormal basis of the kernel.
struct Feasible {
  Eigen::VectorXd particular;
  Eigen::MatrixXd kernel;
};

Feasible feasible(Eigen::MatrixXd constraints, Eigen::VectorXd closure) {
  const Eigen::Index size = constraints.cols();
  if (constraints.rows() == 0)
    return {Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Identity(size, size)};
  for (Eigen::Index row = 0; row < constraints.rows(); ++row) {
    const double length = constraints.row(row).norm();
    constraints.row(row) /= length;
    closure[row] /= length;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(constraints.transpose());
  const Eigen::MatrixXd q = qr.householderQ();
  const Eigen::MatrixXd range = q.leftCols(qr.rank());
  const Eigen::VectorXd inside = (constraints * range).colPivHouseholderQr().solve(closure);
  return {range * inside, q.rightCols(size - qr.rank())};
}

}  // namespace

NormalSolution solve_normal(const NormalSystem& system) {
  NormalSolution out;
  // An unknown that nothing touches keeps the unit 1; it stays open.
  out.unit = system.normal.diagonal().unaryExpr(
      [](double information) { return information > 0 ? 1 / std::sqrt(information) : 1.0; });
  const Feasible set = feasible(system.constraints * out.unit.asDiagonal(), system.closure);
  const Eigen::MatrixXd scaled = out.unit.asDiagonal() * system.normal * out.unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(set.kernel.transpose() * scaled *
                                                                set.kernel);
  const Eigen::VectorXd& values = spectrum.eigenvalues();
  const auto open =
      static_cast<Eigen::Index>((values.array() < rank_tolerance * values.tail<1>()[0]).count());
  const Eigen::Index known = values.size() - open;
  out.rank = static_cast<int>(known);
  const Eigen::MatrixXd directions = set.kernel * spectrum.eigenvectors();
  const Eigen::MatrixXd seen = directions.rightCols(known);
  const Eigen::VectorXd inverse = values.tail(known).cwiseInverse();
  const Eigen::VectorXd right = out.unit.cwiseProduct(system.right) - scaled * set.particular;
  const Eigen::VectorXd step =
      set.particular + seen * inverse.cwiseProduct(seen.transpose() * right);
  out.correction = out.unit.cwiseProduct(step);
  const Eigen::MatrixXd root = out.unit.asDiagonal() * seen * inverse.cwiseSqrt().asDiagonal();
  out.covariance = root * root.transpose();
  out.open = out.unit.asDiagonal() * directions.leftCols(open);
  return out;
}

bool is_determined(const NormalSolution& solution, const Eigen::RowVectorXd& combination) {
  const double unit = combination.cwiseProduct(solution.unit.transpose()).norm();
  return (combination * solution.open).norm() <= leak_tolerance * unit;
}

}  // namespace alea
