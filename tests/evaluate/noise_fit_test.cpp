#include "alea/evaluate/noise_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/simulate/scanner.hpp"

namespace alea {
namespace {

/// Variance of a tile as chance makes it: a chi-square of so many freedoms (Wilson and Hilferty).
double scattered(double variance, double freedoms, double normal) {
  const double part = 2 / (9 * freedoms);
  return variance * std::pow(1 - part + std::sqrt(part) * normal, 3);
}

NoiseTile tile_at(const NoiseModel& noise, double range_m, double incidence_rad, std::size_t points,
                  double normal) {
  NoiseTile tile;
  tile.points = points;
  const double cosine = std::cos(incidence_rad), r2 = range_m * range_m;
  tile.cos2 = cosine * cosine;
  tile.sin2 = 1 - tile.cos2;
  tile.range2_cos2_m2 = r2 * tile.cos2;
  tile.range2_sin2_m2 = r2 * tile.sin2;
  tile.variance_m2 = scattered(std::pow(noise.normal_sd_m(range_m, cosine), 2),
                               static_cast<double>(points) - 3, normal);
  return tile;
}

std::vector<NoiseTile> tiles_of(const NoiseModel& noise, std::uint64_t trial, double far_m = 40) {
  RandomStream stream({5, 0, trial, 0, Purpose::test});
  std::vector<NoiseTile> tiles;
  for (int i = 0; i < 600; ++i) {
    const double range = 2 + (far_m - 2) * stream.uniform(),
                 incidence = 80 * deg * stream.uniform();
    tiles.push_back(tile_at(noise, range, incidence, 100, stream.normal()));
  }
  return tiles;
}

const NoiseModel truth{0.0015, 0.0012, 0, 4e-5, 8e-5};

TEST(NoiseFit, IsRightWithinItsStandardErrors) {
  constexpr int trials = 200;
  std::array<double, 4> sum{}, square{};
  int inside = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto estimate = fit_noise(tiles_of(truth, static_cast<std::uint64_t>(trial)));
    ASSERT_TRUE(estimate) << estimate.refusal().message;
    for (int k = 0; k < 4; ++k) {
      const NoiseTermEstimate& term = estimate->terms[k];
      const double expected = value_of(truth, noise_terms[k]);
      const double z =
          (std::pow(term.value, 2) - expected * expected) / (2 * term.value * term.standard_error);
      sum[k] += z;
      square[k] += z * z;
      inside += term.low <= expected && expected <= term.high ? 1 : 0;
    }
  }
  for (int k = 0; k < 4; ++k) {
    // Means of 200 standard numbers: four standard errors.
    EXPECT_NEAR(sum[k] / trials, 0, 4 / std::sqrt(trials)) << to_string(noise_terms[k]);
    EXPECT_NEAR(square[k] / trials, 1, 0.4) << to_string(noise_terms[k]);
  }
  EXPECT_NEAR(inside / (4.0 * trials), 0.95, 0.035);
}

TEST(NoiseFit, ATermThatIsNotThereIsZeroWithinItsInterval) {
  const auto estimate = fit_noise(tiles_of({0.002, 0.002, 0, 0, 0}, 3));
  ASSERT_TRUE(estimate) << estimate.refusal().message;
  EXPECT_LT(estimate->terms[1].low, 2e-5);
  EXPECT_EQ(estimate->terms[3].low, 0);
}

TEST(NoiseFit, NamesTheTermsThatPlanesAtOneAngleCannotTellApart) {
  std::vector<NoiseTile> tiles;
  RandomStream stream({6, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 200; ++i)
    tiles.push_back(tile_at(truth, 3 + 20 * stream.uniform(), 1 * deg * stream.uniform(), 100,
                            stream.normal()));
  const auto estimate = fit_noise(tiles);
  ASSERT_FALSE(estimate);
  EXPECT_EQ(estimate.refusal().code, RefusalCode::unobservable);
  EXPECT_NE(estimate.refusal().message.find("grazing_m"), std::string::npos)
      << estimate.refusal().message;
  EXPECT_NE(estimate.refusal().message.find("angular_noise_rad"), std::string::npos);
  NoiseFitOptions fixed;
  fixed.fixed[2] = truth.grazing_m;
  fixed.fixed[3] = truth.angular_noise_rad;
  const auto rest = fit_noise(tiles, fixed);
  ASSERT_TRUE(rest) << rest.refusal().message;
  EXPECT_EQ(rest->model.grazing_m, truth.grazing_m);
  EXPECT_NEAR(rest->model.range_noise_m, truth.range_noise_m, 0.0004);
}

TEST(NoiseFit, ATenthOfRoughTilesDoesNotMatter) {
  std::vector<NoiseTile> tiles = tiles_of(truth, 1);
  for (std::size_t i = 0; i < tiles.size(); i += 10) tiles[i].variance_m2 *= 9;
  const auto estimate = fit_noise(tiles);
  ASSERT_TRUE(estimate);
  EXPECT_GE(estimate->tiles_rejected, 55u);
  EXPECT_NEAR(estimate->model.range_noise_m, truth.range_noise_m, 0.0002);
  EXPECT_NEAR(estimate->model.grazing_m, truth.grazing_m, 0.0003);
}

TEST(NoiseFit, KnownRoughnessIsTakenFromTheOtherTerms) {
  NoiseModel rough = truth;
  rough.surface_m = 0.001;
  NoiseFitOptions options;
  options.surface_m = 0.001;
  const auto estimate = fit_noise(tiles_of(rough, 2), options);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->model.surface_m, 0.001);
  EXPECT_NEAR(estimate->model.range_noise_m, truth.range_noise_m, 0.0003);
}

TEST(NoiseFit, TooLittleIsRefused) {
  EXPECT_EQ(fit_noise({}).refusal().code, RefusalCode::too_few_points);
  EXPECT_THROW(calibrate_noise({}), Error) << "no scanner position";
}

/// A hall, seen from one corner.
Cloud hall_scan(const NoiseModel& noise, std::uint64_t trial) {
  Scene scene;
  const Eigen::Vector3d x(30, 0, 0), y(0, 14, 0), z(0, 0, 5);
  for (const Patch& patch :
       {Patch{"floor", {0, 0, 0}, x, y}, Patch{"ceiling", z, y, x}, Patch{"-x", {0, 0, 0}, y, z},
        Patch{"+x", x, z, y}, Patch{"-y", {0, 0, 0}, z, x}, Patch{"+y", y, x, z}})
    scene.patches.push_back(patch);
  Station station;
  station.scene_from_scan = levelled_pose({4, 4, 1.7}, 0.3);
  station.azimuth = {-std::numbers::pi, std::numbers::pi - 0.008, 0.008};
  station.elevation = {-0.9, 0.9, 0.008};
  station.scanner.noise = noise;
  Cloud cloud = simulate_scan(scene, station, {7, 0, trial, 0});
  cloud.scanner_position = Eigen::Vector3d(0, 0, 0);
  return cloud;
}

TEST(NoiseCalibration, FindsTheNoiseOfASimulatedScan) {
  for (const std::uint64_t trial : {0, 1, 2}) {
    const auto estimate = calibrate_noise(hall_scan(truth, trial));
    ASSERT_TRUE(estimate) << estimate.refusal().message;
    for (int k = 0; k < 4; ++k) {
      const NoiseTermEstimate& term = estimate->terms[k];
      EXPECT_NEAR(term.value, value_of(truth, noise_terms[k]), 4 * term.standard_error)
          << to_string(noise_terms[k]) << " of trial " << trial;
    }
    EXPECT_LT(estimate->overdispersion, 1.3);
  }
}

}  // namespace
}  // namespace alea
