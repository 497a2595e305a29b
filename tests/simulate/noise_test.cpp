#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "alea/core/angle.hpp"
#include "alea/core/plane.hpp"
#include "alea/simulate/scanner.hpp"
#include "tests/support/silent_scanner.hpp"

namespace alea {
namespace {

using testing::silent;

/// A wall whose normal at the aim point makes this angle with the ray, seen in a small window.
struct WallView {
  Scene scene;
  Station station;
};

WallView wall_view(double incidence_rad, double step_rad = 2e-3) {
  WallView view;
  const double range_m = 6;
  // Turned about the upright axis through the aim point.
  const Eigen::Vector3d along(std::sin(incidence_rad), std::cos(incidence_rad), 0);
  const Eigen::Vector3d aim(range_m, 0, 0), up(0, 0, 1);
  view.scene.patches.push_back({"wall", aim - 4 * along - 4 * up, 8 * along, 8 * up, 0.5});
  view.station.azimuth = {-0.15, 0.15, step_rad};
  view.station.elevation = {-0.15, 0.15, step_rad};
  view.station.scanner = silent();
  return view;
}

/// Mean and mean square of errors in units of what they should be.
struct Moments {
  double mean = 0, square = 0, fourth = 0;
  std::size_t n = 0;
};

template <typename Error>
Moments moments(const SimulatedScan& scan, Error error_in_sd) {
  Moments out;
  out.n = scan.cloud.size();
  for (std::size_t i = 0; i < out.n; ++i) {
    const double e = error_in_sd(scan.cloud.positions[i], scan.truth[i]);
    out.mean += e / static_cast<double>(out.n);
    out.square += e * e / static_cast<double>(out.n);
    out.fourth += e * e * e * e / static_cast<double>(out.n);
  }
  return out;
}

/// Standard normal: mean 0, variance 1, fourth moment 3, each within four standard errors.
void expect_standard_normal(const Moments& m, const char* what) {
  ASSERT_GT(m.n, 10000u) << what;
  const double n = static_cast<double>(m.n);
  EXPECT_NEAR(m.mean, 0, 4 / std::sqrt(n)) << what;
  EXPECT_NEAR(m.square, 1, 4 * std::sqrt(2 / n)) << what;
  EXPECT_NEAR(m.fourth, 3, 4 * std::sqrt(96 / n)) << what;
}

double range_error(const Eigen::Vector3d& p, const PointTruth& truth) {
  return p.norm() - truth.range_m;
}

TEST(ScanNoise, RangeNoiseIsAlongTheRayWhateverTheIncidence) {
  for (const double incidence : {0.0, 60 * deg, 80 * deg}) {
    WallView view = wall_view(incidence);
    view.station.scanner.noise.range_noise_m = 0.002;
    const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {2, 0, 1, 0});
    expect_standard_normal(
        moments(scan, [](const Eigen::Vector3d& p,
                         const PointTruth& truth) { return range_error(p, truth) / 0.002; }),
        "range");
  }
}

TEST(ScanNoise, TheGrazingTermGrowsWithTheSineAlongTheNormal) {
  WallView view = wall_view(70 * deg);
  view.station.scanner.noise.grazing_m = 0.001;
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {2, 0, 2, 0});
  const Plane wall = plane_of(view.scene.patches[0]);
  expect_standard_normal(moments(scan,
                                 [&](const Eigen::Vector3d& p, const PointTruth& truth) {
                                   const double c = truth.cos_incidence;
                                   return wall.signed_distance(p) / (0.001 * std::sqrt(1 - c * c));
                                 }),
                         "grazing");
  view = wall_view(0, 0.01);
  view.station.azimuth = view.station.elevation = {0, 0, 0.01};
  view.station.scanner.noise.grazing_m = 0.001;
  const SimulatedScan straight = simulate_scan_with_truth(view.scene, view.station, {});
  ASSERT_EQ(straight.cloud.size(), 1u);
  EXPECT_NEAR(straight.cloud.positions[0].x(), 6, 1e-12) << "none at normal incidence";
}

TEST(ScanNoise, SurfaceRoughnessIsAlongTheNormalWhateverTheIncidence) {
  for (const double incidence : {20 * deg, 75 * deg}) {
    WallView view = wall_view(incidence);
    view.station.scanner.noise.surface_m = 0.0008;
    const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {2, 0, 3, 0});
    const Plane wall = plane_of(view.scene.patches[0]);
    expect_standard_normal(
        moments(scan, [&](const Eigen::Vector3d& p,
                          const PointTruth&) { return wall.signed_distance(p) / 0.0008; }),
        "surface");
  }
}

TEST(ScanNoise, AngularNoiseTurnsTheBeamAndKeepsTheReportedDirection) {
  WallView view = wall_view(60 * deg);
  const double sd = 2e-4;
  view.station.scanner.noise.angular_noise_rad = sd;
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {2, 0, 4, 0});
  const Plane wall = plane_of(view.scene.patches[0]);
  expect_standard_normal(moments(scan,
                                 [&](const Eigen::Vector3d& p, const PointTruth&) {
                                   // The plane's range along the reported ray, and how it changes
                                   // with both angles.
                                   const Eigen::Vector3d u = p.normalized();
                                   const double range = wall.offset_m / wall.normal.dot(u);
                                   const Eigen::Vector3d by_azimuth =
                                       Eigen::Vector3d(-u.y(), u.x(), 0);
                                   const Eigen::Vector3d by_elevation =
                                       u.cross(Eigen::Vector3d(u.y(), -u.x(), 0).normalized());
                                   const double slope = std::hypot(wall.normal.dot(by_azimuth),
                                                                   wall.normal.dot(by_elevation)) *
                                                        range / std::abs(wall.normal.dot(u));
                                   return (p.norm() - range) / (sd * slope);
                                 }),
                         "angles");
  for (const Eigen::Vector3d& p : scan.cloud.positions) {
    const double steps = (std::atan2(p.y(), p.x()) + 0.15) / 2e-3;
    EXPECT_NEAR(steps, std::round(steps), 1e-9) << "the reported azimuth is on the grid";
  }
}

TEST(ScanNoise, IntensityNoiseHasItsStandardDeviation) {
  WallView view = wall_view(0);
  view.station.scanner.intensity_noise = 0.05;
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {2, 0, 5, 0});
  std::size_t i = 0;
  expect_standard_normal(
      moments(scan, [&](const Eigen::Vector3d&,
                        const PointTruth&) { return (scan.cloud.intensity[i++] - 0.5) / 0.05; }),
      "intensity");
}

// Every switch by itself: a cause adds what it adds alone, whatever else is on.
TEST(ScanNoise, CausesAddUpAndDoNotDisturbEachOther) {
  const auto errors = [](const NoiseModel& noise, double intensity_noise) {
    WallView view = wall_view(50 * deg, 0.01);
    view.station.scanner.noise = noise;
    view.station.scanner.intensity_noise = intensity_noise;
    const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {2, 0, 6, 0});
    std::vector<double> out;
    for (std::size_t i = 0; i < scan.cloud.size(); ++i)
      out.push_back(range_error(scan.cloud.positions[i], scan.truth[i]));
    return out;
  };
  const auto all = errors({0.002, 0.001, 0.0008, 0}, 0.1);
  const auto silent_intensity = errors({0.002, 0.001, 0.0008, 0}, 0);
  const auto range = errors({0.002, 0, 0, 0}, 0), grazing = errors({0, 0.001, 0, 0}, 0.1),
             surface = errors({0, 0, 0.0008, 0}, 0);
  ASSERT_EQ(all.size(), range.size());
  EXPECT_EQ(all, silent_intensity);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_NEAR(all[i], range[i] + grazing[i] + surface[i], 1e-14);
}

/// A board before a wall: its edge is upright and at y = 0.
WallView edge_view() {
  WallView view;
  view.scene.patches.push_back({"front", {4, 0, -1}, {0, 2, 0}, {0, 0, 2}, 0.9});
  view.scene.patches.push_back({"back", {5, -3, -2}, {0, 6, 0}, {0, 0, 4}, 0.1});
  view.station.azimuth = {-0.01, 0.01, 2e-4};
  view.station.elevation = {-0.02, 0.02, 2e-3};
  view.station.scanner = silent();
  view.station.scanner.beam_diameter_m = 0.008;
  view.station.scanner.beam_rings = 3;
  return view;
}

TEST(Footprint, ABeamOverAnEdgeGivesMixedPixelsOnlyThere) {
  const WallView view = edge_view();
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {});
  int mixed = 0;
  for (const Eigen::Vector3d& p : scan.cloud.positions) {
    // Where the beam's centre passes the board's plane, across its edge.
    const double off_m = 4 * p.y() / p.x();
    const bool between = p.x() > 4.01 && p.x() < 4.99;
    if (std::abs(off_m) > 0.0045) {
      EXPECT_FALSE(between) << "off the edge by " << off_m;
    }
    if (std::abs(off_m) < 0.003) {
      EXPECT_TRUE(between) << "at " << off_m;
    }
    mixed += between;
  }
  EXPECT_GT(mixed, 50);
}

TEST(Footprint, WithoutMixedPixelsTheRangeIsSharpAndTheIntensityBlurred) {
  WallView view = edge_view();
  view.station.scanner.mixed_pixels = false;
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {});
  int blurred = 0;
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Eigen::Vector3d& p = scan.cloud.positions[i];
    EXPECT_LT(std::min(std::abs(p.x() - 4), std::abs(p.x() - 5)), 1e-9);
    const float intensity = scan.cloud.intensity[i];
    blurred += intensity > 0.12F && intensity < 0.88F;
  }
  EXPECT_GT(blurred, 50);
}

TEST(Footprint, TheShareOfTheBoardFallsAcrossTheEdgeLikeADiscCutByALine) {
  const WallView view = edge_view();
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {});
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Eigen::Vector3d& p = scan.cloud.positions[i];
    const double x = std::clamp(4 * p.y() / p.x() / 0.004, -1.0, 1.0);
    const double covered = 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
    const double share = (scan.cloud.intensity[i] - 0.1) / 0.8;
    // 37 sub-rays stand for the disc: their steps are up to a seventh of it.
    EXPECT_NEAR(share, covered, 0.11);
  }
}

TEST(Footprint, ZeroDiameterIsThePointBeam) {
  WallView view = edge_view();
  view.station.scanner.beam_diameter_m = 0;
  const SimulatedScan scan = simulate_scan_with_truth(view.scene, view.station, {});
  for (const float intensity : scan.cloud.intensity)
    EXPECT_TRUE(intensity == 0.9F || intensity == 0.1F);
}

}  // namespace
}  // namespace alea
