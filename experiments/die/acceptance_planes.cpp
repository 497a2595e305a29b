#include <Eigen/Cholesky>
#include <array>
#include <string>
#include <vector>

#include "alea/core/parallel.hpp"
#include "alea/die/plane_match.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/engine/sample_mean.hpp"

namespace alea::acceptance {
namespace {

constexpr std::uint64_t plane_trials = 10000;
constexpr double planes_step_rad = 4e-3;

/// Three walls of 0.8 m and a piece of floor about the origin, which both stations see.
std::vector<Patch> patches() {
  return {{"floor", {-0.3, -0.3, 0}, {0.6, 0, 0}, {0, 0.6, 0}},
          {"wall x", {-2.5, -0.4, 0.6}, {0, 0.8, 0}, {0, 0, 0.8}},
          {"wall y", {-0.4, -2.5, 0.6}, {0.8, 0, 0}, {0, 0, 0.8}},
          {"slanted", {-2.2, -1.6, 0.6}, {0.56, -0.56, 0}, {0, 0, 0.8}}};
}

std::array<RigidTransform, 2> poses() {
  return {levelled_pose({4, 1, 1.6}, 3.4), levelled_pose({1, 4, 1.6}, -1.9)};
}

PlaneFit seen(const Patch& patch, const RigidTransform& pose, const SimulationKey& key) {
  Scene scene;
  scene.patches = {patch};
  const RandomStream phases({key.seed, key.experiment, key.trial, key.scan, Purpose::station});
  const auto [column, row] = phases.uniform2_at(0);
  const Station station =
      aimed_station(pose, bounding_ball(patch), planes_step_rad, Eigen::Vector2d(column, row));
  return fit_plane(simulate_scan(scene, station, key).positions, {});
}

/// Squared error over its covariance of the transform that the patches alone give.
double nees_of(std::uint64_t seed, std::uint64_t trial) {
  const auto stations = poses();
  const RigidTransform truth = stations[0].inverse() * stations[1];
  std::vector<PlaneFit> master, slave;
  std::uint32_t part = 0;
  for (const Patch& patch : patches()) {
    master.push_back(seen(patch, stations[0], {seed, 33, trial, part++}));
    slave.push_back(seen(patch, stations[1], {seed, 33, trial, part++}));
  }
  const auto rows = static_cast<Eigen::Index>(3 * master.size());
  RigidTransform estimate = truth;
  LeastSquares solution;
  for (int pass = 0; pass < 3; ++pass) {
    Misclosures m{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, 6),
                  Eigen::MatrixXd::Zero(rows, rows)};
    for (std::size_t k = 0; k < master.size(); ++k) {
      const PlaneMatch match = match_planes(master[k], slave[k], estimate);
      const auto row = static_cast<Eigen::Index>(3 * k);
      m.value.segment<3>(row) = match.residual;
      m.by_unknowns.middleRows<3>(row) = match.by_transform;
      m.covariance.block<3, 3>(row, row) = master[k].covariance + match.by_source *
                                                                      slave[k].covariance *
                                                                      match.by_source.transpose();
    }
    solution = solve_misclosures(m);
    estimate = perturb_left(estimate, solution.correction, Eigen::Vector3d::Zero());
  }
  const Vector6d error = left_difference(truth, estimate, Eigen::Vector3d::Zero());
  return error.dot(solution.covariance.ldlt().solve(error));
}

}  // namespace

void run_planes_only(const Options& options, const Report& report) {
  std::vector<double> nees(options.trials_or(plane_trials)), inside(nees.size());
  parallel_chunks(nees.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      nees[t] = nees_of(options.seed, t) / 6;
      inside[t] = 6 * nees[t] <= chi_square_95_of_six ? 1 : 0;
    }
  });
  for (Cell cell :
       {mean_cell("planes only: NEES / 6", nees, within(1, 0.05)),
        mean_cell("planes only: inside the 95 % region", inside, within(0.95, 0.015))}) {
    cell.judgement = options.judgement(plane_trials);
    report(cell);
  }
}

}  // namespace alea::acceptance
