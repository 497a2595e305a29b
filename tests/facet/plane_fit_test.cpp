#include "alea/facet/plane_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "tests/facet/angle_between.hpp"

namespace alea {
namespace {

/// A square facet seen from the origin on a regular grid of rays, noise along the ray.
struct Facet {
  Eigen::Vector3d middle{4.2, 4.2, -1.3};
  Eigen::Vector3d e1{1, 0, 0}, e2{0, 1, 0};
  double edge_m = 0.5, step_rad = 1e-3;
  double bow_m = 0;  // depth of the middle below the rim

  Eigen::Vector3d normal() const {
    const Eigen::Vector3d n = e1.cross(e2).normalized();
    return n.dot(middle) < 0 ? n : Eigen::Vector3d(-n);
  }
};

std::vector<Eigen::Vector3d> scan(const Facet& facet, const NoiseModel& noise,
                                  std::uint64_t trial) {
  const RandomStream stream({3, 1, trial, 0, Purpose::test});
  const Eigen::Vector3d axis = facet.middle.normalized();
  const Eigen::Matrix<double, 3, 2> across = tangent_basis(axis);
  const int reach = static_cast<int>(0.8 * facet.edge_m / facet.middle.norm() / facet.step_rad);
  std::vector<Eigen::Vector3d> points;
  std::uint64_t index = 0;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const Eigen::Vector3d ray =
          (axis + facet.step_rad * (across * Eigen::Vector2d(i + 0.37, j + 0.21))).normalized();
      const double range = facet.normal().dot(facet.middle) / facet.normal().dot(ray);
      const Eigen::Vector3d at = range * ray - facet.middle;
      const double u = 2 * at.dot(facet.e1) / facet.edge_m, v = 2 * at.dot(facet.e2) / facet.edge_m;
      if (std::abs(u) > 1 || std::abs(v) > 1) continue;
      const double cosine = -facet.normal().dot(ray);
      const double bow = facet.bow_m * (1 - u * u) * (1 - v * v) / cosine;
      const double sd = noise.range_sd_m(range, cosine);
      points.emplace_back((range + bow + sd * stream.normal_at(index++)) * ray);
    }
  }
  return points;
}

Facet side_facet() {
  Facet facet;
  facet.e1 = Eigen::Vector3d(1, 0.1, 0.02).normalized();
  facet.e2 = (Eigen::Vector3d::UnitZ() - facet.e1.z() * facet.e1).normalized();
  return facet;
}

NoiseModel without_pointing() {
  NoiseModel noise;
  noise.angular_noise_rad = 0;
  return noise;
}

PlaneFitOptions along_ray() {
  PlaneFitOptions options;
  options.noise = without_pointing();
  return options;
}

TEST(PlaneFit, NoiseFreePointsGiveThePlaneToRounding) {
  NoiseModel silent{0, 0, 0, 0};
  for (const Facet& facet : {Facet{}, side_facet()}) {
    const auto points = scan(facet, silent, 0);
    for (const FitMethod method : {FitMethod::orthogonal, FitMethod::along_ray}) {
      PlaneFitOptions options = along_ray();
      options.method = method;
      const PlaneFit fit = fit_plane(points, options);
      EXPECT_LT(angle_rad(fit.plane.normal, facet.normal()), 1e-9);
      EXPECT_NEAR(fit.plane.signed_distance(facet.middle), 0, 1e-10);
      EXPECT_GT(fit.plane.normal.dot(-fit.centroid_m), 0) << "the normal points to the scanner";
      EXPECT_NEAR(fit.plane.signed_distance(fit.centroid_m), 0, 1e-14);
    }
  }
}

TEST(PlaneFit, TheRayFitMinimisesTheLinearProblemInNormalOverDistance) {
  const Facet facet = side_facet();
  const NoiseModel noise = without_pointing();
  const auto points = scan(facet, noise, 1);
  const PlaneFit fit = fit_plane(points, along_ray());
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d ray = p.normalized();
    const double predicted = fit.plane.offset_m / fit.plane.normal.dot(ray);
    const double sd = noise.range_sd_m(predicted, -fit.plane.normal.dot(ray));
    const double weight = std::pow(predicted, 4) / (sd * sd);
    information += weight * ray * ray.transpose();
    right += weight / p.norm() * ray;
  }
  const Eigen::Vector3d m = information.ldlt().solve(right);
  EXPECT_LT(angle_rad(-m, fit.plane.normal), 3e-6);
  EXPECT_NEAR(m.dot(fit.centroid_m), 1, 1e-6);
}

// Monte Carlo, n = 600: variance ratios have a standard deviation of sqrt(2 / n) = 5.8 %, so 0.78
// to 1.22 holds with 99.9 %; a mean over its own standard deviation stays within 4.
TEST(PlaneFit, TheCovarianceIsTheScatterOfTheFitAndTheRayFitHasNoBias) {
  for (const bool area_weights : {false, true}) {
    for (const Facet& facet : {Facet{}, side_facet()}) {
      const NoiseModel noise = without_pointing();
      PlaneFitOptions options = along_ray();
      options.area_weights = area_weights;
      constexpr int n = 600;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum, expected = sum;
      for (int trial = 0; trial < n; ++trial) {
        Facet coarse = facet;
        coarse.step_rad = 3e-3;
        const PlaneFit fit =
            fit_plane(scan(coarse, noise, static_cast<std::uint64_t>(trial)), options);
        // The fit's tangent turns with its noise, so the errors are taken along the facet's axes.
        const Eigen::Matrix<double, 2, 2> turn =
            (Eigen::Matrix<double, 2, 3>() << facet.e1.transpose(), facet.e2.transpose())
                .finished() *
            fit.tangent;
        const Eigen::Vector3d error(fit.plane.normal.dot(facet.e1), fit.plane.normal.dot(facet.e2),
                                    facet.normal().dot(fit.centroid_m - facet.middle));
        const Eigen::Matrix2d tilt = turn * fit.covariance.topLeftCorner<2, 2>() * turn.transpose();
        const Eigen::Vector3d variance(tilt(0, 0), tilt(1, 1), fit.covariance(2, 2));
        sum += error, squares += error.cwiseAbs2(), expected += variance;
      }
      for (int k = 0; k < 3; ++k) {
        EXPECT_GT(squares[k] / expected[k], 0.78) << k << " area weights " << area_weights;
        EXPECT_LT(squares[k] / expected[k], 1.22) << k << " area weights " << area_weights;
        EXPECT_LT(std::abs(sum[k] / n) / std::sqrt(expected[k] / n / n), 4) << k;
      }
    }
  }
}

// sigma_n^2 tan(incidence) / (L^2 / 12): the domain mixed on purpose, n = 400.
TEST(PlaneFit, PrincipalComponentsOfRaySelectedPointsTiltByThePredictedBias) {
  Facet top;
  top.step_rad = 2e-3;
  const NoiseModel noise = without_pointing();
  PlaneFitOptions options = along_ray();
  options.method = FitMethod::orthogonal;
  constexpr int n = 400;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int trial = 0; trial < n; ++trial)
    mean +=
        fit_plane(scan(top, noise, static_cast<std::uint64_t>(trial)), options).plane.normal / n;
  const double cosine = -top.normal().dot(top.middle.normalized());
  const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
  const double sd = noise.normal_sd_m(top.middle.norm(), cosine);
  const double predicted = sd * sd * tangent / (top.edge_m * top.edge_m / 12);
  EXPECT_NEAR(angle_rad(mean, top.normal()) / predicted, 1, 0.15);
}

TEST(PlaneFit, MovingCloudAndScannerFarAwayChangesNothing) {
  const Eigen::Vector3d far(5e5, -5e5, 3e5);
  auto points = scan(side_facet(), NoiseModel{}, 2);
  for (const FitMethod method : {FitMethod::orthogonal, FitMethod::along_ray}) {
    PlaneFitOptions options = along_ray();
    options.method = method;
    const PlaneFit near = fit_plane(points, options);
    auto moved = points;
    for (Eigen::Vector3d& p : moved) p += far;
    options.scanner_position = far;
    const PlaneFit fit = fit_plane(moved, options);
    EXPECT_LT(angle_rad(near.plane.normal, fit.plane.normal), 1e-9);
    EXPECT_LT((fit.centroid_m - far - near.centroid_m).norm(), 1e-7);
    EXPECT_NEAR(fit.rmse_m, near.rmse_m, 1e-9);
  }
}

TEST(PlaneFit, AnyOrderOfThePointsGivesTheSameBits) {
  auto points = scan(Facet{}, NoiseModel{}, 4);
  for (const bool robust : {false, true}) {
    PlaneFitOptions options = along_ray();
    options.robust = robust;
    const PlaneFit forward = fit_plane(points, options);
    std::reverse(points.begin(), points.end());
    std::rotate(points.begin(), points.begin() + 17, points.end());
    const PlaneFit back = fit_plane(points, options);
    EXPECT_EQ(forward.plane.normal, back.plane.normal);
    EXPECT_EQ(forward.plane.offset_m, back.plane.offset_m);
    EXPECT_EQ(forward.covariance, back.covariance);
    EXPECT_EQ(forward.rmse_m, back.rmse_m);
  }
}

TEST(PlaneFit, AreaWeightsGiveAWarpedFacetOnePlaneFromWhereverItIsSeen) {
  NoiseModel silent{0, 0, 0, 0};
  Facet bowed = side_facet();
  bowed.bow_m = 0.005;
  bowed.middle = {3, 1.2, -0.3};
  const auto points = scan(bowed, silent, 0);
  PlaneFitOptions options = along_ray();
  const double plain = angle_rad(fit_plane(points, options).plane.normal, bowed.normal());
  options.area_weights = true;
  const double weighted = angle_rad(fit_plane(points, options).plane.normal, bowed.normal());
  EXPECT_LT(weighted, 0.3 * plain);
}

TEST(PlaneFit, TheVarianceFactorTellsNoiseBeyondTheModel) {
  NoiseModel loud = without_pointing();
  loud.range_noise_m *= 2, loud.grazing_m *= 2, loud.surface_m *= 2;
  const PlaneFit expected = fit_plane(scan(side_facet(), without_pointing(), 5), along_ray());
  const PlaneFit louder = fit_plane(scan(side_facet(), loud, 5), along_ray());
  EXPECT_NEAR(expected.variance_factor, 1, 0.1);
  EXPECT_NEAR(louder.variance_factor, 4, 0.4);
  EXPECT_NEAR(louder.covariance(0, 0) / expected.covariance(0, 0), 4, 0.4);
}

TEST(PlaneFit, TheRobustFitShrugsOffPointsOfAnotherSurface) {
  auto points = scan(side_facet(), without_pointing(), 6);
  for (std::size_t i = 0; i < points.size() / 20; ++i) points[i] *= 1.02;
  PlaneFitOptions options = along_ray();
  const double plain = angle_rad(fit_plane(points, options).plane.normal, side_facet().normal());
  options.robust = true;
  const double robust = angle_rad(fit_plane(points, options).plane.normal, side_facet().normal());
  EXPECT_LT(robust, 0.1 * plain);
}

TEST(PlaneFit, RefusesToGuess) {
  const std::vector<Eigen::Vector3d> two{{1, 0, 0}, {0, 1, 0}};
  const std::vector<Eigen::Vector3d> line{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  const std::vector<Eigen::Vector3d> same(4, Eigen::Vector3d(1, 2, 3));
  for (const auto& points : {two, line, same}) EXPECT_THROW(fit_plane(points, {}), Error);
  PlaneFitOptions nowhere;
  nowhere.scanner_position.reset();
  EXPECT_THROW(fit_plane(scan(Facet{}, {}, 0), nowhere), Error);
  nowhere.method = FitMethod::orthogonal;
  EXPECT_NO_THROW(fit_plane(scan(Facet{}, {}, 0), nowhere));
}

}  // namespace
}  // namespace alea
