#include "alea/evaluate/fisher_bound.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/evaluate/fisher_information.hpp"

namespace {

using namespace alea;

DieBoundCase die_case(double edge_m, double range_m, bool shape_known) {
  DieBoundCase geometry;
  geometry.edge_m = edge_m;
  geometry.range_m = range_m;
  geometry.shape_known = shape_known;
  return geometry;
}

// Stations on a ring of 6 m round a cube of 0.5 m, in one sense of rotation.
FisherScene ring_scene(const std::vector<double>& azimuths_deg, double tilt_sd_rad,
                       double offset_sd_m) {
  FisherScene scene;
  for (const double azimuth : azimuths_deg)
    scene.stations.push_back(station_at(6, azimuth * deg, 1.6, 3e-4));
  scene.bodies = {free_body(cube_on_floor(0.5))};
  scene.bodies[0].tilt_sd_rad = tilt_sd_rad;
  scene.bodies[0].offset_sd_m = offset_sd_m;
  return scene;
}

TEST(FisherBound, ReproducesTheStudyForAKnownAndAFreeShape) {
  struct Row {
    double edge_m, range_m, k_deg, k_mm, l_deg, l_mm;
  };
  for (const Row& row : {Row{0.1, 3, 0.0482, 0.034, 0.0628, 0.077},
                         {0.3, 12, 0.0265, 0.073, 0.0480, 0.155},
                         {0.5, 6, 0.0044, 0.018, 0.0068, 0.038}}) {
    const PoseAccuracy k = die_bound(die_case(row.edge_m, row.range_m, true));
    const PoseAccuracy l = die_bound(die_case(row.edge_m, row.range_m, false));
    EXPECT_NEAR(k.rotation_rad / deg, row.k_deg, 0.03 * row.k_deg + 5e-5);
    EXPECT_NEAR(l.rotation_rad / deg, row.l_deg, 0.03 * row.l_deg + 5e-5);
    EXPECT_NEAR(k.translation_m * 1e3, row.k_mm, 0.03 * row.k_mm + 5e-4);
    EXPECT_NEAR(l.translation_m * 1e3, row.l_mm, 0.03 * row.l_mm + 5e-4);
  }
}

TEST(FisherBound, GrowsInProportionToNoiseAndStep) {
  DieBoundCase geometry = die_case(0.5, 6, false);
  const PoseAccuracy one = die_bound(geometry);
  geometry.step_rad *= 3;
  NoiseModel& noise = geometry.noise;
  noise = {2 * noise.range_noise_m, 2 * noise.grazing_m, 2 * noise.surface_m,
           2 * noise.angular_noise_rad};
  const PoseAccuracy six = die_bound(geometry);
  EXPECT_NEAR(six.rotation_rad, 6 * one.rotation_rad, 1e-9 * six.rotation_rad);
  EXPECT_NEAR(six.ring10_m, 6 * one.ring10_m, 1e-9 * six.ring10_m);
}

TEST(FisherBound, WithoutALengthTranslationIsAsGoodAsTheLength) {
  const FisherScene scene = ring_scene({45, 135}, 0.4 * deg, 0.010);
  const auto covariance = relative_covariance(fisher_bound(scene), 0, 1, {0, 0, 0.25});
  ASSERT_TRUE(covariance);
  EXPECT_NEAR(pose_accuracy(*covariance).translation_m, std::sqrt(2) * 0.010, 5e-5);
  EXPECT_NEAR(pose_accuracy(*covariance).rotation_rad / deg, 0.0068, 0.0003);
}

TEST(FisherBound, CountsWhatTheStationsLeaveOpen) {
  const double free = unknown_sd;
  EXPECT_EQ(fisher_bound(ring_scene({45, 135}, free, free)).defect, 1);
  EXPECT_EQ(fisher_bound(ring_scene({45, 225}, free, free)).defect, 3);
  EXPECT_EQ(fisher_bound(ring_scene({45, 165, 285}, free, free)).defect, 2);
  EXPECT_EQ(fisher_bound(ring_scene({45, 135, 225, 315}, free, free)).defect, 2);
  EXPECT_EQ(fisher_bound(ring_scene({45, 105, 165, 225, 285, 345}, free, free)).defect, 2);
  EXPECT_EQ(fisher_bound(ring_scene({45, 135}, free, 0)).defect, 0);
  EXPECT_EQ(fisher_bound(ring_scene({45, 225}, free, 0)).defect, 1);
  EXPECT_EQ(fisher_bound(ring_scene({45, 135}, 0, 0)).defect, 0);
}

TEST(FisherBound, RefusesAPoseThatStaysOpen) {
  const auto refused = relative_covariance(
      fisher_bound(ring_scene({45, 135}, unknown_sd, unknown_sd)), 0, 1, {0, 0, 0.25});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.refusal().code, RefusalCode::unobservable);
}

TEST(FisherBound, SameCornerNeedsNoLength) {
  const auto covariance = relative_covariance(
      fisher_bound(ring_scene({35, 55}, unknown_sd, unknown_sd)), 0, 1, {0, 0, 0.25});
  ASSERT_TRUE(covariance);
  EXPECT_NEAR(pose_accuracy(*covariance).rotation_rad / deg, 0.0045, 0.0002);
}

TEST(FisherBound, LevelledStationsHelpAndLeaveFourFreedoms) {
  FisherScene scene = die_bound_scene(die_case(0.5, 12, false));
  for (FisherStation& station : scene.stations) station.level_sd_rad = 3.0 / 3600 * deg;
  const FisherBound bound = fisher_bound(scene);
  EXPECT_EQ(bound.defect, 0);
  const PoseAccuracy accuracy = pose_accuracy(*relative_covariance(bound, 0, 1, {0, 0, 0.25}));
  EXPECT_NEAR(accuracy.rotation_rad / deg, 0.0066, 0.0066 * 0.06);
  EXPECT_NEAR(accuracy.ring10_m, 1.14e-3, 1.14e-3 * 0.06);
}

TEST(FisherBound, DoesNotDependOnTheSceneFrame) {
  const FisherScene scene = die_bound_scene(die_case(0.5, 6, false));
  const RigidTransform move{rotation_exp({0.3, -0.2, 1.1}), {40, -7, 3}};
  std::vector<Plane> planes;
  for (const Plane& plane : cube_on_floor(0.5)) {
    const Eigen::Vector3d normal = move.rotation * plane.normal;
    planes.push_back({normal, plane.offset_m + normal.dot(move.translation)});
  }
  FisherScene moved = scene;
  moved.bodies = {free_body(planes)};
  moved.bodies[0].edges = scene.bodies[0].edges;
  for (FisherStation& station : moved.stations)
    station.scene_from_scan = move * station.scene_from_scan;
  const Eigen::Vector3d about(0, 0, 0.25);
  const auto a = relative_covariance(fisher_bound(scene), 0, 1, about);
  const auto b = relative_covariance(fisher_bound(moved), 0, 1, move * about);
  EXPECT_LT((a->covariance - b->covariance).norm(), 1e-6 * a->covariance.norm());
  EXPECT_LT((a->about_m - b->about_m).norm(), 1e-9);
}

TEST(FisherBound, SumsTheRaysOfTheGrid) {
  const FisherStation station = station_at(4, 0.7, 1.6, 2e-3);
  const FisherBody body = free_body(cube_on_floor(0.5));
  const FisherFacet& top = body.facets[2];
  double rays = 0;
  for (double azimuth = -std::numbers::pi; azimuth < std::numbers::pi; azimuth += 2e-3) {
    for (double elevation = -1.5; elevation < 0; elevation += 2e-3) {
      const Eigen::Vector3d u(std::cos(azimuth) * std::cos(elevation),
                              std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
      const Eigen::Vector3d& eye = station.scene_from_scan.translation;
      const Eigen::Vector3d x = eye + u * ((0.5 - eye.z()) / u.z());
      if (std::abs(x.x()) > 0.25 || std::abs(x.y()) > 0.25) continue;
      const double sd = NoiseModel{}.normal_sd_m((x - eye).norm(), u.z());
      rays += 1 / (sd * sd);
    }
  }
  EXPECT_NEAR(facet_information(top, station, {})(0, 0), rays, 0.02 * rays);
}

TEST(FisherBound, SphereSpreadsItsInformationOverTheDisc) {
  // A distant scanner covers the disc evenly. With a constant noise s along the normal the
  // information is N / s^2 times the mean of n n' over the disc: 1/2 along the ray, 1/4 across.
  const NoiseModel noise{0, 0, 0.001, 0};
  const FisherSphere sphere{{0, 0, 0}, 0.0725, true};
  const Eigen::Matrix4d uniform = sphere_information(sphere, station_at(50, 0, 0, 1e-4), noise);
  EXPECT_NEAR(uniform(0, 0) / uniform(3, 3), 0.5, 0.01);
  EXPECT_NEAR(uniform(1, 1) / uniform(3, 3), 0.25, 0.01);
  const double rays = std::numbers::pi * std::pow(0.0725 / 50 / 1e-4, 2);
  EXPECT_NEAR(uniform(3, 3) * 1e-6, rays, 0.01 * rays);
}

TEST(FisherBound, SaysWhatIsMissing) {
  EXPECT_THROW(fisher_bound({}), Error);
  EXPECT_THROW(facet_of_planes({{{1, 0, 0}, 1}, {{1, 0, 0}, 0.5}}, 0), Error);
  const FisherScene opposite = ring_scene({45, 225}, unknown_sd, unknown_sd);
  EXPECT_THROW(shared_edge(opposite.bodies[0], opposite.stations[0], opposite.stations[1]), Error);
}

}  // namespace
