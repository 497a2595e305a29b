#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/pipeline/register_spheres.hpp"
#include "alea/sphere/sphere_finder.hpp"
#include "alea/sphere/sphere_match.hpp"
#include "tests/sphere/sphere_scene.hpp"

namespace {

using namespace alea;
using namespace alea::test;

const RigidTransform first_pose{rotation_exp({0, 0, 0.3}), {0.2, 0.1, 1.5}};
const RigidTransform second_pose{rotation_exp({0.02, -0.01, 2.2}), {-0.4, 0.5, 1.3}};

Cloud scan_of(const std::vector<Eigen::Vector3d>& balls, const RigidTransform& pose,
              std::uint32_t scan) {
  return simulate_scan(furnished_room(balls), room_station(pose, 6e-3), {7, 0, 0, scan});
}

/// The scans that most tests share, made once.
const Cloud& master_scan() {
  static const Cloud cloud = scan_of(ball_places(), first_pose, 0);
  return cloud;
}
const Cloud& slave_scan() {
  static const Cloud cloud = scan_of(ball_places(), second_pose, 1);
  return cloud;
}

Cloud lone_ball(double distance_m, double step_rad, std::uint64_t trial, const NoiseModel& noise) {
  Scene scene;
  scene.spheres = {{"", {distance_m, 0, 0}, ball_radius_m, 0.9}};
  Station station = aimed_station({}, bounding_ball(scene.spheres[0]), step_rad);
  station.scanner.noise = noise;
  return simulate_scan(scene, station, {3, 0, trial, 0});
}

SphereFit fit_at(const Eigen::Vector3d& centre, double sd = 1e-4) {
  SphereFit fit;
  fit.centre_m = centre;
  fit.covariance = sd * sd * Eigen::Matrix3d::Identity();
  return fit;
}

std::vector<SphereFit> fits_at(const std::vector<Eigen::Vector3d>& centres,
                               const RigidTransform& move = {}) {
  std::vector<SphereFit> fits;
  for (const Eigen::Vector3d& centre : centres) fits.push_back(fit_at(move * centre));
  return fits;
}

TEST(SphereFit, IsExactWithoutNoise) {
  const Cloud cloud = lone_ball(5, 1e-3, 0, {0, 0, 0, 0});
  for (const auto method : {SphereFitMethod::along_ray, SphereFitMethod::geometric}) {
    for (const bool known : {true, false}) {
      SphereFitOptions options;
      options.method = method;
      options.radius_known = known;
      const auto fit = fit_sphere(cloud.positions, {5.015, 0.01, -0.012}, options);
      ASSERT_TRUE(fit);
      EXPECT_LT((fit->centre_m - Eigen::Vector3d(5, 0, 0)).norm(), 1e-9);
      EXPECT_NEAR(fit->radius_m, ball_radius_m, 1e-9);
    }
  }
}

// 200 trials: the mean of 600 squares of standardised coordinates is 1 +- 0.058 (one sd); the mean
// error has a z score. The geometric fit is the control: its bias towards the scanner must show.
TEST(SphereFit, CovarianceAlongTheRayIsTrueAndTheGeometricFitIsBiased) {
  SphereFitOptions options;
  double squares = 0, ray_bias = 0, ray_variance = 0, geometric_bias = 0;
  const int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    const Cloud cloud = lone_ball(6, 1e-3, static_cast<std::uint64_t>(trial), {});
    options.method = SphereFitMethod::along_ray;
    const auto ray = fit_sphere(cloud.positions, {6, 0.002, 0}, options);
    options.method = SphereFitMethod::geometric;
    const auto geometric = fit_sphere(cloud.positions, {6, 0.002, 0}, options);
    ASSERT_TRUE(ray && geometric);
    const Eigen::Vector3d error = ray->centre_m - Eigen::Vector3d(6, 0, 0);
    squares += error.dot(ray->covariance.inverse() * error) / 3;
    ray_bias += error.x();
    ray_variance += ray->covariance(0, 0);
    geometric_bias += geometric->centre_m.x() - 6;
  }
  EXPECT_NEAR(squares / trials, 1, 0.2);
  const double sd_of_mean = std::sqrt(ray_variance) / trials;
  EXPECT_LT(std::abs(ray_bias / trials), 4 * sd_of_mean);
  EXPECT_LT(geometric_bias / trials, -4 * sd_of_mean);
}

TEST(SphereFit, RefusesTooFewPointsAndRejectsARadiusOfZero) {
  const Cloud cloud = lone_ball(6, 1e-2, 0, {});
  const auto fit = fit_sphere(cloud.positions, {6, 0, 0}, {});
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.refusal().code, RefusalCode::too_few_points);
  SphereFitOptions options;
  options.radius_m = 0;
  EXPECT_THROW(fit_sphere(cloud.positions, {6, 0, 0}, options), Error);
}

TEST(SphereFinder, FindsEveryBallOfAFurnishedRoomAndNothingElse) {
  const auto found = find_spheres(master_scan(), {});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), ball_places().size());
  for (const SphereTarget& target : *found) {
    const Eigen::Vector3d centre = first_pose * target.fit.centre_m;
    double nearest = 1;
    for (const Eigen::Vector3d& place : ball_places())
      nearest = std::min(nearest, (place - centre).norm());
    EXPECT_LT(nearest, 0.002);
  }
}

TEST(SphereFinder, RefusesARoomWithoutBallsAndBallsOfAnotherSize) {
  const auto empty = find_spheres(scan_of({}, first_pose, 0), {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.refusal().code, RefusalCode::no_target);
  SphereFinderOptions larger;
  larger.fit.radius_m = 0.1;
  EXPECT_FALSE(find_spheres(master_scan(), larger));
}

TEST(SphereFinder, SameBitsForAnyOrderAndThreads) {
  const Cloud& cloud = master_scan();
  Cloud shuffled;
  const std::size_t n = cloud.size();
  for (std::size_t i = 0; i < n; ++i)
    shuffled.positions.push_back(cloud.positions[(i * 7919 + 13) % n]);
  ASSERT_EQ(std::gcd(n, std::size_t{7919}), 1u);
  const auto a = find_spheres(cloud, {});
  const ThreadLimit one(1);
  const auto b = find_spheres(shuffled, {});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->size(), b->size());
  for (std::size_t k = 0; k < a->size(); ++k) {
    EXPECT_EQ((*a)[k].fit.centre_m, (*b)[k].fit.centre_m);
    EXPECT_EQ((*a)[k].fit.covariance, (*b)[k].fit.covariance);
  }
}

TEST(SphereMatch, PairsByDistancesWhateverTheOrderAndTheStrangers) {
  const RigidTransform slave_from_master = second_pose.inverse() * first_pose;
  std::vector<Eigen::Vector3d> places = ball_places();
  std::reverse(places.begin(), places.end());
  places.erase(places.begin() + 2);
  places.push_back({4, 3, 2});
  places.push_back({-4, 3, 1});
  const auto result =
      match_and_register(fits_at(ball_places()), fits_at(places, slave_from_master));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->pairs.size(), 5u);
  EXPECT_LT((result->master_from_slave.matrix() - slave_from_master.inverse().matrix()).norm(),
            1e-9);
}

TEST(SphereMatch, RefusesWhatDistancesCannotDecide) {
  std::vector<Eigen::Vector3d> hexagon, line, mirrored;
  for (int k = 0; k < 6; ++k) {
    const double turn = k * std::numbers::pi / 3;
    hexagon.push_back({4 * std::cos(turn), 4 * std::sin(turn), 0});
    line.push_back({0.5 * k * k, 1, 0});
  }
  for (const Eigen::Vector3d& p : ball_places()) mirrored.push_back({p.x(), p.y(), -p.z()});
  const auto code = [](const std::vector<Eigen::Vector3d>& a,
                       const std::vector<Eigen::Vector3d>& b) {
    const auto result = match_and_register(fits_at(a), fits_at(b));
    return result ? "registered" : std::string(to_string(result.refusal().code));
  };
  EXPECT_EQ(code(hexagon, hexagon), "no_match");
  EXPECT_EQ(code(line, line), "collinear");
  EXPECT_EQ(code(ball_places(), mirrored), "no_match");
  EXPECT_EQ(code(ball_places(), {{9, 0, 0}, {0, 11, 0}, {0, 0, 17}}), "no_match");
  EXPECT_EQ(code({{1, 0, 0}, {0, 1, 0}}, ball_places()), "too_few_points");
}

TEST(RegisterSpheres, FindsThePoseOfTheSecondScan) {
  const auto result = register_spheres(master_scan(), slave_scan(), {});
  ASSERT_TRUE(result);
  const SphereRegistration& registration = result->registration;
  EXPECT_EQ(registration.pairs.size(), 6u);
  const RigidTransform truth = first_pose.inverse() * second_pose;
  const Vector6d error =
      left_difference(truth, registration.master_from_slave, registration.covariance.about_m);
  // Chi square with six freedoms: 22.5 is its 99.9 % point.
  EXPECT_LT(error.dot(registration.covariance.covariance.inverse() * error), 22.5);
  EXPECT_LT(
      rotation_angle_rad(truth.rotation.transpose() * registration.master_from_slave.rotation),
      5e-4);
}

TEST(RegisterSpheres, DoesNotDependOnWhereTheOriginIs) {
  Cloud master = master_scan();
  const Cloud& slave = slave_scan();
  const auto near = register_spheres(master, slave, {});
  const Eigen::Vector3d offset(5e5, -3e5, 1e3);
  for (Eigen::Vector3d& p : master.positions) p += offset;
  master.scanner_position = offset;
  const auto far = register_spheres(master, slave, {});
  ASSERT_TRUE(near && far);
  const RigidTransform& a = near->registration.master_from_slave;
  const RigidTransform& b = far->registration.master_from_slave;
  EXPECT_LT((b.translation - offset - a.translation).norm(), 1e-6);
  EXPECT_LT((b.rotation - a.rotation).norm(), 1e-9);
}

}  // namespace
