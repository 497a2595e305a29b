#include "alea/die/calibration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"

namespace alea {
namespace {

constexpr double offset_sd_m = 2e-4, tilt_sd_rad = 1e-4;

PlaneFit plane_at(const Eigen::Vector3d& normal, const Eigen::Vector3d& centroid) {
  PlaneFit fit;
  fit.plane = {normal, normal.dot(centroid)};
  fit.centroid_m = centroid;
  fit.tangent = tangent_basis(normal);
  fit.covariance.diagonal() << tilt_sd_rad * tilt_sd_rad, tilt_sd_rad * tilt_sd_rad,
      offset_sd_m * offset_sd_m;
  return fit;
}

PlaneFit with_noise(const PlaneFit& fit, RandomStream& stream) {
  const Eigen::Vector2d tilt(tilt_sd_rad * stream.normal(), tilt_sd_rad * stream.normal());
  const Eigen::Vector3d normal = (fit.plane.normal + fit.tangent * tilt).normalized();
  PlaneFit out = plane_at(normal, fit.centroid_m + offset_sd_m * stream.normal() * normal);
  out.covariance = fit.covariance;
  return out;
}

/// Two walls and a floor, seen from two scans that a shared edge along (0.6, 0.8, 0) connects.
struct Room {
  RigidTransform master_from_slave{rotation_exp({0.02, -0.03, 1.6}), {5, 4, 0.1}};
  Eigen::Vector3d edge{0.6, 0.8, 0};
  double true_length_m = 0.487;

  std::vector<PlanePair> pairs(const std::vector<Eigen::Vector3d>& normals,
                               RandomStream* stream = nullptr) const {
    std::vector<PlanePair> out;
    const RigidTransform slave_from_master = master_from_slave.inverse();
    for (const Eigen::Vector3d& normal : normals) {
      const Eigen::Vector3d in_master = 4 * normal + Eigen::Vector3d(0.3, -0.2, 0.5);
      const Eigen::Vector3d aside = in_master + 0.2 * tangent_basis(normal).col(0);
      PlanePair pair{plane_at(normal, in_master),
                     plane_at(slave_from_master.rotation * normal, slave_from_master * aside)};
      if (stream != nullptr)
        pair = {with_noise(pair.master, *stream), with_noise(pair.slave, *stream)};
      out.push_back(pair);
    }
    return out;
  }
  /// The transform that a wrong length gives.
  LengthModel model(double assumed_m) const {
    LengthModel out;
    out.master_from_slave = master_from_slave;
    out.master_from_slave.translation += (assumed_m - true_length_m) * edge;
    out.lengths_m = Eigen::VectorXd::Constant(1, assumed_m);
    out.directions = edge;
    return out;
  }
};

const std::vector<Eigen::Vector3d> walls{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(Calibration, OneLinearSolveFindsTheEdgeAndSaysWhichPlanesToldIt) {
  const Room room;
  const auto result = calibrate_lengths(room.pairs(walls), room.model(0.5));
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->lengths_m[0], room.true_length_m, 1e-12);
  EXPECT_NEAR(result->sensitivity(0, 0), 0.6, 1e-12);
  EXPECT_NEAR(result->sensitivity(1, 0), 0.8, 1e-12);
  EXPECT_NEAR(result->sensitivity(2, 0), 0.0, 1e-12);
  EXPECT_TRUE(result->observable[0]);
  EXPECT_EQ(result->redundancy, 2);
  EXPECT_LT(result->offsets_m.norm(), 1e-12);
  EXPECT_LT((result->master_from_slave.translation - room.master_from_slave.translation).norm(),
            1e-12);
}

// Monte Carlo, n = 2000: the ratio of a variance to its expectation has sd sqrt(2 / n) = 3.2 %.
TEST(Calibration, TheVarianceIsTheScatterAndTheFactorIsOne) {
  const Room room;
  RandomStream stream({23, 2, 0, 0, Purpose::test});
  constexpr int n = 2000;
  double squares = 0, expected = 0, factor = 0;
  for (int i = 0; i < n; ++i) {
    const auto result = calibrate_lengths(room.pairs(walls, &stream), room.model(0.5));
    ASSERT_TRUE(result);
    squares += std::pow(result->lengths_m[0] - room.true_length_m, 2);
    expected += result->covariance(0, 0);
    factor += result->variance_factor / n;
  }
  EXPECT_NEAR(squares / expected, 1, 0.1);
  EXPECT_NEAR(factor, 1, 0.1);
}

TEST(Calibration, AnUncertainTransformMakesTheLengthLessCertain) {
  const Room room;
  LengthModel model = room.model(0.5);
  const auto sure = calibrate_lengths(room.pairs(walls), model);
  model.covariance = TransformCovariance{};
  model.covariance->covariance.diagonal().head<3>().setConstant(std::pow(5e-4, 2));
  const auto unsure = calibrate_lengths(room.pairs(walls), model);
  ASSERT_TRUE(sure && unsure);
  EXPECT_GT(unsure->covariance(0, 0), 1.2 * sure->covariance(0, 0));
}

TEST(Calibration, WhatThePlanesDoNotTellIsNotGivenANumber) {
  const Room room;
  const auto refused = calibrate_lengths(room.pairs({{0, 0, 1}, {0.8, -0.6, 0}}), room.model(0.5));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.refusal().code, RefusalCode::unobservable);

  LengthModel three = room.model(0.5);
  three.lengths_m = Eigen::Vector3d(0.5, 0.5, 0.5);
  three.directions = Eigen::Matrix3d::Identity();
  const auto some = calibrate_lengths(room.pairs({{1, 0, 0}, {0, 0, 1}}), three);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->observable, (std::vector<bool>{true, false, true}));
  EXPECT_TRUE(std::isinf(some->covariance(1, 1)));
  EXPECT_EQ(some->lengths_m[1], 0.5);

  // One plane for two lengths: only their sum shows.
  LengthModel two = room.model(0.5);
  two.lengths_m = Eigen::Vector2d(0.5, 0.5);
  two.directions = Eigen::Matrix<double, 3, 2>::Zero();
  two.directions(0, 0) = two.directions(0, 1) = 1;
  EXPECT_FALSE(calibrate_lengths(room.pairs({{1, 0, 0}}), two));
}

TEST(Calibration, GoldenSectionAgreesWithTheLinearSolve) {
  const Room room;
  const auto pairs = room.pairs(walls);
  const LengthModel model = room.model(0.5);
  const auto objective = [&](double length) {
    return rms_offset_m(pairs, at_lengths(model, Eigen::VectorXd::Constant(1, length)));
  };
  const GoldenSection found = golden_section(objective, 0.46, 0.54, 1e-4);
  EXPECT_NEAR(found.argument, room.true_length_m, 1e-4);
  EXPECT_LT(found.evaluations, 20);
  EXPECT_FALSE(found.at_border);
  EXPECT_GT(found.rise, 10);

  const auto floor_only = room.pairs({{0, 0, 1}});
  const GoldenSection blind = golden_section(
      [&](double length) {
        return 1e-3 +
               rms_offset_m(floor_only, at_lengths(model, Eigen::VectorXd::Constant(1, length)));
      },
      0.46, 0.54, 1e-4);
  EXPECT_LT(blind.rise, 1e-6) << "a flat objective shows as one";
  EXPECT_THROW(golden_section(objective, 1, 0, 1e-4), Error);
}

}  // namespace
}  // namespace alea
