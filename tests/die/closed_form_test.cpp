#include "alea/die/closed_form.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "experiments/die/skewed_die.hpp"
#include "tests/die/skewed_observation.hpp"

namespace alea {
namespace {

using experiments::die::draw_skewed_die;
using experiments::die::pose_error;
using experiments::die::SkewedDie;
using experiments::die::SkewedDieOptions;

ClosedFormOptions with_edge(const SkewedDie& die) {
  ClosedFormOptions options;
  options.edge_m = die.shared_edge_m.value_or(0.5);
  return options;
}

TEST(ClosedForm, IsExactForTwoAndThreeSharedFacetsWithoutNoise) {
  for (const double separation_deg : {30.0, 90.0})
    for (std::uint64_t trial = 0; trial < 30; ++trial) {
      const SkewedDie die = skewed(separation_deg, trial, 2);
      const auto found = register_closed_form(die.master, die.slave, with_edge(die));
      ASSERT_TRUE(found);
      const auto error = pose_error(found->master_from_slave, die);
      EXPECT_LT(error.rotation_rad, 1e-12);
      EXPECT_LT(error.at_die_m, 1e-12);
      EXPECT_TRUE(found->covariance.covariance.isZero(0));
    }
}

TEST(ClosedForm, AKnownShapeIsExactForAnyNumberOfSharedFacets) {
  for (const double separation_deg : {0.0, 40.0, 90.0, 180.0}) {
    const SkewedDie die = skewed(separation_deg, 7, 2);
    ClosedFormOptions options;
    options.shape = die.shape;
    const auto found = register_closed_form(die.master, die.slave, options);
    ASSERT_TRUE(found);
    const auto error = pose_error(found->master_from_slave, die);
    EXPECT_LT(error.rotation_rad, 1e-12);
    EXPECT_LT(error.at_die_m, 1e-12);
  }
}

TEST(ClosedForm, TheDerivativeByTheEdgeIsWhatALongerEdgeDoes) {
  const SkewedDie die = skewed(90, 3);
  SkewedDie weighted = die;
  set_covariances(weighted.master);
  set_covariances(weighted.slave);
  RandomStream stream({61, 0, 0, 0, Purpose::test});
  const ObservedDie master = noisy(weighted.master, stream), slave = noisy(weighted.slave, stream);
  ClosedFormOptions options = with_edge(die);
  const auto before = register_closed_form(master, slave, options);
  *options.edge_m += 0.01;
  const auto after = register_closed_form(master, slave, options);
  ASSERT_TRUE(before && after);
  const Eigen::Vector3d moved =
      (after->master_from_slave.translation - before->master_from_slave.translation) / 0.01;
  // The direction is the master's own: off by its error, some 1e-5 rad here.
  EXPECT_NEAR((moved - before->translation_by_edge).norm(), 0, 1e-4);
  EXPECT_NEAR(before->translation_by_edge.norm(), 1, 1e-12);
  EXPECT_LT(rotation_angle_rad(after->master_from_slave.rotation *
                               before->master_from_slave.rotation.transpose()),
            1e-12);
}

struct NoiseCase {
  double separation_deg;
  double edge_sd_m;
  bool shape_known;
};

void PrintTo(const NoiseCase& test, std::ostream* out) {
  *out << test.separation_deg << " deg apart, edge known to " << test.edge_sd_m << " m, shape "
       << (test.shape_known ? "known" : "unknown");
}

class ClosedFormCovariance : public ::testing::TestWithParam<NoiseCase> {};

// n = 400: NEES/6 has the standard error sqrt(2/6/n) = 0.029; 4 sd. The chi-square of the
// misclosures has the mean `freedom` and the standard error sqrt(2 freedom/n).
TEST_P(ClosedFormCovariance, ExplainsTheErrorsAndTheMisclosures) {
  const NoiseCase test = GetParam();
  SkewedDie die = skewed(test.separation_deg, 11);
  set_covariances(die.master);
  set_covariances(die.slave);
  ClosedFormOptions options = with_edge(die);
  const double edge_m = *options.edge_m;
  options.edge_sd_m = test.edge_sd_m;
  if (test.shape_known) options.shape = die.shape;
  RandomStream stream({62, 0, 0, 0, Purpose::test});
  const int n = 400;
  double nees = 0, chi_square = 0;
  int freedom = 0;
  for (int trial = 0; trial < n; ++trial) {
    options.edge_m = edge_m + test.edge_sd_m * stream.normal();
    const auto found =
        register_closed_form(noisy(die.master, stream), noisy(die.slave, stream), options);
    ASSERT_TRUE(found);
    const Vector6d error =
        left_difference(die.master_from_slave, found->master_from_slave, found->covariance.about_m);
    nees += error.dot(found->covariance.covariance.ldlt().solve(error));
    chi_square += found->misclosure_chi_square;
    freedom = found->misclosure_freedom;
  }
  EXPECT_NEAR(nees / n / 6, 1, 4 * std::sqrt(2.0 / 6 / n));
  EXPECT_NEAR(chi_square / n, freedom, 4 * std::sqrt(2.0 * freedom / n));
}

INSTANTIATE_TEST_SUITE_P(Stations, ClosedFormCovariance,
                         ::testing::Values(NoiseCase{90, 0, false}, NoiseCase{90, 0.001, false},
                                           NoiseCase{30, 0, false}, NoiseCase{90, 0, true},
                                           NoiseCase{180, 0, true}));

// The die itself is drawn from the prior: cubes with tilts of 0.4 deg, seen from opposite sides.
// n = 200 dice: the standard error of NEES/3 is sqrt(2/3/n) = 0.058; 4 sd.
TEST(ClosedForm, ATiltPriorCarriesOneSharedFacetWithAnHonestRotation) {
  ClosedFormOptions options;
  options.edge_m = 0.5;
  options.tilt_prior_rad = 0.4 * deg;
  RandomStream stream({63, 0, 0, 0, Purpose::test});
  const int n = 200;
  double nees = 0;
  for (int trial = 0; trial < n; ++trial) {
    SkewedDieOptions drawn;
    drawn.tilt_sd_rad = 0.4 * deg;
    drawn.separation_rad = std::numbers::pi;
    SkewedDie die = draw_skewed_die(drawn, 6, trial);
    set_covariances(die.master);
    set_covariances(die.slave);
    const auto found =
        register_closed_form(noisy(die.master, stream), noisy(die.slave, stream), options);
    ASSERT_TRUE(found);
    const Eigen::Vector3d turn =
        left_difference(die.master_from_slave, found->master_from_slave, found->covariance.about_m)
            .head<3>();
    const Eigen::Matrix3d rotation = found->covariance.covariance.topLeftCorner<3, 3>();
    nees += turn.dot(rotation.ldlt().solve(turn)) / n;
    // The heading, which the upper facet does not see, is known to about the prior itself.
    EXPECT_NEAR(std::sqrt(rotation(2, 2)) / (0.4 * deg), 1, 0.05);
  }
  EXPECT_NEAR(nees / 3, 1, 4 * std::sqrt(2.0 / 3 / n));
}

TEST(ClosedForm, RefusesOneSharedFacetWithoutShapeOrPrior) {
  const SkewedDie die = skewed(180, 1);
  ClosedFormOptions options;
  options.edge_m = 0.5;
  const auto found = register_closed_form(die.master, die.slave, options);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.refusal().code, RefusalCode::one_shared_facet);
}

TEST(ClosedForm, RefusesTwoSharedFacetsWithoutALength) {
  const SkewedDie die = skewed(90, 1);
  const auto found = register_closed_form(die.master, die.slave, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.refusal().code, RefusalCode::unobservable);
  EXPECT_NE(found.refusal().message.find("1-3"), std::string::npos);
}

TEST(ClosedForm, AShapeThatLacksAFacetStillGivesTheLengthOfTheEdge) {
  const SkewedDie die = skewed(90, 2);
  ClosedFormOptions options;
  options.shape = die.shape;
  options.shape->facets[3].reset();  // 4 pips: neither on the shared edge nor at its ends
  const auto found = register_closed_form(die.master, die.slave, options);
  ASSERT_TRUE(found);
  EXPECT_LT(pose_error(found->master_from_slave, die).at_die_m, 1e-12);
  EXPECT_NEAR(found->edge_m.value(), die.shared_edge_m.value(), 1e-12);
}

TEST(ClosedForm, FarOriginsChangeNothing) {
  const SkewedDie die = skewed(90, 4);
  const Eigen::Vector3d far(5e5, -3e5, 1e3);
  SkewedDie moved = die;
  for (ObservedDie* scan : {&moved.master, &moved.slave})
    for (ObservedFacet& facet : scan->facets) {
      facet.fit.centroid_m += far;
      facet.fit.plane.offset_m += facet.fit.plane.normal.dot(far);
    }
  const auto near = register_closed_form(die.master, die.slave, with_edge(die));
  const auto away = register_closed_form(moved.master, moved.slave, with_edge(die));
  ASSERT_TRUE(near && away);
  EXPECT_LT(rotation_angle_rad(near->master_from_slave.rotation *
                               away->master_from_slave.rotation.transpose()),
            1e-9);
  const Eigen::Vector3d at_die = die.master_from_slave.inverse() * die.centre_in_master_m;
  EXPECT_LT(
      (away->master_from_slave * (at_die + far) - far - near->master_from_slave * at_die).norm(),
      1e-8);
  EXPECT_GT(away->covariance.about_m.norm(), 1e5);  // about the die, not about the far origin
  EXPECT_TRUE(near->covariance.about_m.isZero(0));
}

TEST(ClosedForm, RejectsLengthsThatAreNone) {
  const SkewedDie die = skewed(90, 1);
  ClosedFormOptions options;
  options.edge_m = -0.5;
  EXPECT_THROW(register_closed_form(die.master, die.slave, options), Error);
  options.edge_m = 0.5;
  options.edge_sd_m = -1;
  EXPECT_THROW(register_closed_form(die.master, die.slave, options), Error);
}

}  // namespace
}  // namespace alea
