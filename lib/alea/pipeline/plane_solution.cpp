#include "alea/pipeline/plane_solution.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "alea/die/plane_match.hpp"

namespace alea {
namespace {

constexpr double least_spread = 0.01;
constexpr int most_iterations = 20;
constexpr double settled = 1e-12;  // of the correction, rad and m

bool normals_span(std::span<const CommonPlane> planes) {
  if (planes.size() < 3) return false;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const CommonPlane& plane : planes) {
    const Eigen::Vector3d& normal = plane.fit_master.plane.normal;
    sum += normal * normal.transpose() / static_cast<double>(planes.size());
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum, Eigen::EigenvaluesOnly)
             .eigenvalues()[0] > least_spread;
}

/// All pairs in a master frame whose origin is `about_m`.
Misclosures misclosures_at(std::span<const CommonPlane> planes, const RigidTransform& transform,
                           const Eigen::Vector3d& about_m) {
  const auto rows = static_cast<Eigen::Index>(3 * planes.size());
  Misclosures m{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, 6),
                Eigen::MatrixXd::Zero(rows, rows)};
  const RigidTransform centred{transform.rotation, transform.translation - about_m};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneMatch match =
        match_planes(recentred(planes[i].fit_master, about_m), planes[i].fit_slave, centred);
    const auto row = static_cast<Eigen::Index>(3 * i);
    m.value.segment<3>(row) = match.residual;
    m.by_unknowns.middleRows<3>(row) = match.by_transform;
    m.covariance.block<3, 3>(row, row) =
        planes[i].fit_master.covariance +
        match.by_source * planes[i].fit_slave.covariance * match.by_source.transpose();
  }
  return m;
}

}  // namespace

Result<PlaneSolution> solve_planes(std::span<const CommonPlane> planes,
                                   const RigidTransform& start) {
  if (!normals_span(planes))
    return Refusal{
        RefusalCode::unobservable,
        fmt::format("the normals of the {} planes that both scans see do not span space; "
                    "floor and two walls that are not parallel are needed",
                    planes.size())};
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();
  for (const CommonPlane& plane : planes)
    about_m += plane.fit_master.centroid_m / static_cast<double>(planes.size());
  PlaneSolution solution{start, {}, 1, 0};
  const auto freedom = static_cast<double>(3 * planes.size()) - 6;
  while (solution.iterations < most_iterations) {
    const LeastSquares step =
        solve_misclosures(misclosures_at(planes, solution.master_from_slave, about_m));
    solution.master_from_slave =
        perturb_left(solution.master_from_slave, Vector6d(step.correction), about_m);
    ++solution.iterations;
    solution.variance_factor = freedom > 0 ? step.chi_square / freedom : 1;
    solution.covariance = {step.covariance * std::max(1.0, solution.variance_factor), about_m};
    if (step.correction.cwiseAbs().maxCoeff() < settled) break;
  }
  return solution;
}

}  // namespace alea
