#include "alea/simulate/scanner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "tests/support/silent_scanner.hpp"

namespace alea {
namespace {

using testing::silent;

/// A die on the floor, seen at 45 deg to two of its sides from 1.6 m above it.
struct DieView {
  Scene scene;
  Station station;
};

DieView die_view(double range_m, double step_rad, const DieModel& model = {}) {
  DieView view;
  view.scene.dice.push_back(build_die(model));
  const double side = range_m / std::sqrt(2.0);
  const Eigen::Vector3d die = model.scene_from_die.translation;
  view.station = aimed_station(levelled_pose(die + Eigen::Vector3d(side, side, 1.35), 0.3),
                               bounding_ball(view.scene.dice[0]), step_rad);
  view.station.scanner = silent();
  return view;
}

TEST(Scanner, NoiseFreePointsLieOnTheFacetsThatTheTruthNames) {
  DieModel model;
  model.facets[0].tilt_u_rad = 0.02;
  model.facets[2].offset_m = 0.004;
  model.scene_from_die.translation = {3, -2, 0.1};
  const DieView view = die_view(6, 1e-3, model);
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {});
  ASSERT_GT(scan.cloud.size(), 5000u);
  ASSERT_EQ(scan.truth.size(), scan.cloud.size());
  std::array<int, 7> points{};
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const int pips = scan.truth[i].surface.facet;
    ++points[pips];
    const Eigen::Vector3d p = view.station.scene_from_scan * scan.cloud.positions[i];
    EXPECT_NEAR(view.scene.dice[0].body.planes[pips - 1].signed_distance(p), 0, 1e-12);
    EXPECT_NEAR(scan.cloud.positions[i].norm(), scan.truth[i].range_m, 1e-12);
  }
  EXPECT_GT(points[1], 100) << "the top";
  EXPECT_GT(points[2], 1000);
  EXPECT_GT(points[3], 1000);
  EXPECT_EQ(points[4] + points[5] + points[6], 0) << "facets that look away";
}

TEST(Scanner, SameBitsForOneAndTwoThreads) {
  DieView view = die_view(4, 1e-3);
  view.station.scanner = {};
  view.station.scanner.beam_diameter_m = 0.006;
  const SimulationKey key{7, 1, 42, 1};
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return simulate_scan(view.scene, view.station, key);
  };
  const Cloud one = with_threads(1), two = with_threads(2);
  ASSERT_GT(one.size(), 1000u);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.intensity, two.intensity);
}

TEST(Scanner, AnotherTrialHasOtherNoise) {
  DieView view = die_view(4, 2e-3);
  view.station.scanner = {};
  view.station.scanner.noise.angular_noise_rad = 0;  // the same rays hit
  const Cloud a = simulate_scan(view.scene, view.station, {1, 0, 0, 0});
  const Cloud b = simulate_scan(view.scene, view.station, {1, 0, 1, 0});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NE(a.positions[i], b.positions[i]);
}

TEST(Scanner, RangeNoiseGrowsWithTheRangeAndNothingElse) {
  for (const double range_m : {10.0, 40.0}) {
    DieView view = die_view(range_m, 1e-4 * 40 / range_m);
    view.station.scanner.noise.range_growth = 2e-4;
    const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {3, 0, 0, 0});
    ASSERT_GT(scan.cloud.size(), 5000u);
    double square = 0;
    for (std::size_t i = 0; i < scan.cloud.size(); ++i)
      square += std::pow(
          (scan.cloud.positions[i].norm() - scan.truth[i].range_m) / (2e-4 * scan.truth[i].range_m),
          2);
    const auto n = static_cast<double>(scan.cloud.size());
    EXPECT_NEAR(square / n, 1, 4 * std::sqrt(2 / n)) << "at " << range_m << " m";
  }
}

TEST(Scanner, RefusesAnEmptyGrid) {
  Station station;
  station.azimuth = {1, 0, 1e-3};
  EXPECT_THROW(simulate_scan({}, station, {}), Error);
}

}  // namespace
}  // namespace alea
