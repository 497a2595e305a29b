#include "experiments/die/plane_moments.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "alea/core/seed.hpp"
#include "alea/facet/plane_fit.hpp"

namespace alea::experiments::die {
namespace {

std::vector<Eigen::Vector3d> noisy_plane(std::uint64_t trial, std::size_t count) {
  RandomStream stream({3, 0, trial, 0, Purpose::test});
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(3 + stream.uniform(), stream.uniform() - 2, 1 + 0.002 * stream.normal());
  return points;
}

TEST(PlaneMoments, GiveTheRmseOfTheOrthogonalFit) {
  const std::vector<Eigen::Vector3d> points = noisy_plane(0, 500);
  const PlaneFit fit = fit_plane(points, {.method = FitMethod::orthogonal});
  EXPECT_NEAR(fit_rmse_m(plane_moments(points)), fit.rmse_m, 1e-12);
  EXPECT_NEAR(std::abs(fit_normal(plane_moments(points)).dot(fit.plane.normal)), 1, 1e-12);
}

TEST(PlaneMoments, MovedAndJoinedAreTheMomentsOfTheMovedAndJoinedPoints) {
  const std::vector<Eigen::Vector3d> a = noisy_plane(1, 300), b = noisy_plane(2, 200);
  const RigidTransform to_from{rotation_exp({0.1, -0.4, 0.9}), {1, -2, 0.5}};
  std::vector<Eigen::Vector3d> together = a;
  for (const Eigen::Vector3d& p : b) together.push_back(to_from * p);
  const PlaneMoments direct = plane_moments(together);
  const PlaneMoments composed = joined(plane_moments(a), moved(plane_moments(b), to_from));
  EXPECT_DOUBLE_EQ(direct.count, composed.count);
  EXPECT_LT((direct.mean_m - composed.mean_m).norm(), 1e-12);
  EXPECT_LT((direct.scatter_m2 - composed.scatter_m2).norm(), 1e-9);
}

}  // namespace
}  // namespace alea::experiments::die
