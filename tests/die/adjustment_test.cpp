#include "alea/die/adjustment.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/die/ideal_observation.hpp"
#include "experiments/die/skewed_die.hpp"
#include "tests/die/skewed_observation.hpp"

namespace alea {
namespace {

using experiments::die::pose_error;
using experiments::die::SkewedDie;

std::vector<AdjustmentScan> two_scans(const SkewedDie& die) {
  return {{die.master, {}}, {die.slave, {}}};
}

AdjustmentOptions free_with_edge(const SkewedDie& die) {
  AdjustmentOptions options;
  options.shape = free_shape(cube(0.5, Chirality::clockwise));
  const auto shared = shared_pips(die.master, die.slave);
  if (shared.size() == 2) options.edges = {{{shared[0], shared[1]}, die.shared_edge_m.value(), 0}};
  return options;
}

/// Levelled stations around a die at these azimuths, without noise but with a covariance.
struct Ring {
  DieShape shape;
  std::vector<RigidTransform> die_from_scan;
  std::vector<AdjustmentScan> scans;
};

Ring ring(const std::vector<double>& azimuths_deg, std::uint64_t trial, double tilt_deg = 0.4) {
  Ring out;
  out.shape = skewed(90, trial, tilt_deg).shape;
  for (const double azimuth_deg : azimuths_deg) {
    const double azimuth = azimuth_deg * deg;
    RigidTransform die_from_scan;
    die_from_scan.rotation = rotation_exp({0, 0, azimuth + std::numbers::pi});
    die_from_scan.translation = {6 * std::cos(azimuth), 6 * std::sin(azimuth), 1.35};
    out.die_from_scan.push_back(die_from_scan);
    out.scans.push_back(
        {observe_exactly(out.shape, facing_pips(out.shape, die_from_scan.translation),
                         die_from_scan.inverse(), plane_covariance(1)),
         {}});
  }
  return out;
}

TEST(Adjustment, IsExactWithoutNoiseForAFreeShapeWithItsSharedEdge) {
  for (const double separation_deg : {30.0, 90.0})
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
      const SkewedDie die = skewed(separation_deg, trial, 2);
      const auto found = adjust_die(two_scans(die), free_with_edge(die));
      ASSERT_TRUE(found) << found.refusal().message;
      const auto error = pose_error(found->poses[1].master_from_scan, die);
      EXPECT_LT(error.rotation_rad, 1e-10);
      EXPECT_LT(error.at_die_m, 1e-10);
      EXPECT_EQ(found->defect, 0);
      EXPECT_TRUE(found->poses[1].covariance.covariance.isZero(0));
    }
}

TEST(Adjustment, AKnownShapeIsExactForAnyNumberOfSharedFacets) {
  for (const double separation_deg : {0.0, 40.0, 90.0, 180.0}) {
    const SkewedDie die = skewed(separation_deg, 7, 2);
    AdjustmentOptions options;
    options.shape = exact_shape(die.shape);
    const auto found = adjust_die(two_scans(die), options);
    ASSERT_TRUE(found);
    EXPECT_LT(pose_error(found->poses[1].master_from_scan, die).at_die_m, 1e-10);
    EXPECT_EQ(found->freedom, 6);
  }
}

TEST(Adjustment, AgreesWithTheClosedFormUnderNoise) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    SkewedDie die = skewed(90, trial);
    RandomStream stream({1, 0, trial, 0, Purpose::test});
    die.master = noisy(die.master, stream);
    die.slave = noisy(die.slave, stream);
    ClosedFormOptions closed;
    closed.edge_m = die.shared_edge_m;
    const auto expected = register_closed_form(die.master, die.slave, closed);
    const auto found = adjust_die(two_scans(die), free_with_edge(die));
    ASSERT_TRUE(expected && found);
    const TransformCovariance& covariance = found->poses[1].covariance;
    const Vector6d apart = left_difference(expected->master_from_slave,
                                           found->poses[1].master_from_scan, covariance.about_m);
    // Within 2 % of a standard deviation: both are the same optimum.
    EXPECT_LT(std::sqrt(apart.dot(covariance.covariance.ldlt().solve(apart))), 0.02);
    EXPECT_NEAR(covariance.covariance.trace() / expected->covariance.covariance.trace(), 1, 0.01);
    EXPECT_NEAR(found->chi_square, expected->misclosure_chi_square,
                0.02 + 0.02 * found->chi_square);
    EXPECT_EQ(found->freedom, 1);
  }
}

TEST(Adjustment, ItsCovarianceIsThatOfItsErrors) {
  double nees_known = 0, nees_free = 0;
  const int trials = 150;
  for (int trial = 0; trial < trials; ++trial) {
    SkewedDie die = skewed(90, static_cast<std::uint64_t>(trial), 0.4);
    RandomStream stream({2, 0, static_cast<std::uint64_t>(trial), 0, Purpose::test});
    die.master = noisy(die.master, stream);
    die.slave = noisy(die.slave, stream);
    AdjustmentOptions known;
    known.shape = exact_shape(die.shape);
    for (const bool shape_known : {true, false}) {
      const auto found = adjust_die(two_scans(die), shape_known ? known : free_with_edge(die));
      ASSERT_TRUE(found);
      const TransformCovariance& covariance = found->poses[1].covariance;
      const Vector6d error = left_difference(die.master_from_slave,
                                             found->poses[1].master_from_scan, covariance.about_m);
      (shape_known ? nees_known : nees_free) +=
          error.dot(covariance.covariance.ldlt().solve(error)) / 6 / trials;
    }
  }
  // Standard deviation of the mean: sqrt(2 / 6 / 150) = 0.047.
  EXPECT_NEAR(nees_known, 1, 0.16);
  EXPECT_NEAR(nees_free, 1, 0.16);
}

struct RankCase {
  std::vector<double> azimuths_deg;
  int defect;
  std::vector<std::string> words;
};

TEST(Adjustment, CountsAndNamesWhatStationsCannotSee) {
  const std::vector<RankCase> cases{
      {{45, 135}, 1, {"length along"}},
      {{45, 225}, 3, {"length along", "length along", "angle between"}},
      {{45, 165, 285}, 2, {"length along 2-5", "length along 3-4"}},
      {{45, 135, 225, 315}, 2, {"length along 2-5", "length along 3-4"}},
      {{45, 105, 165, 225, 285, 345}, 2, {"length along 2-5", "length along 3-4"}}};
  for (const RankCase& rank_case : cases) {
    AdjustmentOptions options;
    options.shape = free_shape(cube(0.5, Chirality::clockwise));
    Ring stations = ring(rank_case.azimuths_deg, 3);
    RandomStream stream({4, 0, 0, 0, Purpose::test});
    for (AdjustmentScan& scan : stations.scans) scan.die = noisy(scan.die, stream);
    const auto found = adjust_die(stations.scans, options);
    ASSERT_TRUE(found) << found.refusal().message;
    EXPECT_EQ(found->defect, rank_case.defect);
    ASSERT_EQ(found->open.size(), rank_case.words.size());
    for (std::size_t k = 0; k < rank_case.words.size(); ++k)
      EXPECT_NE(found->open[k].find(rank_case.words[k]), std::string::npos) << found->open[k];
    int numbers = 0;
    for (const AdjustedEdge& edge : found->edges) numbers += edge.length_m ? 1 : 0;
    EXPECT_EQ(numbers, 0) << "a number for a length that nothing determines";
  }
}

TEST(Adjustment, ARingDeterminesAllTiltsThatItSees) {
  const Ring stations = ring({45, 135, 225, 315}, 5);
  AdjustmentOptions options;
  options.shape = free_shape(cube(0.5, Chirality::clockwise));
  const auto found = adjust_die(stations.scans, options);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->shape.facets[5]);  // the die stands on six
  for (int first = 1; first <= 4; ++first)
    for (int second = first + 1; second <= 5; ++second)
      EXPECT_NEAR(found->shape.facet(first)->normal.dot(found->shape.facet(second)->normal),
                  stations.shape.facet(first)->normal.dot(stations.shape.facet(second)->normal),
                  1e-9)
          << first << second;
}

/// The adjustment at a known shape after a facet of the slave was turned about its centroid by
/// `angle_rad` towards `direction`.
DieAdjustment adjusted_with_turned_facet(SkewedDie die, std::size_t facet, double angle_rad,
                                         const Eigen::Vector3d& direction) {
  PlaneFit& wrong = die.slave.facets[facet].fit;
  const Eigen::Vector3d& normal = wrong.plane.normal;
  const Eigen::Vector3d along = (direction - direction.dot(normal) * normal).normalized();
  wrong.plane.normal = (normal + std::tan(angle_rad) * along).normalized();
  wrong.plane.offset_m = wrong.plane.normal.dot(wrong.centroid_m);
  wrong.tangent = tangent_basis(wrong.plane.normal);
  AdjustmentOptions options;
  options.shape = exact_shape(die.shape);
  const Result<DieAdjustment> adjusted = adjust_die(two_scans(die), options);
  EXPECT_TRUE(adjusted);
  return *adjusted;
}

SkewedDie noisy_die_of_known_shape() {
  SkewedDie die = skewed(90, 3, 0.4);
  RandomStream stream({3, 0, 0, 0, Purpose::test});
  die.master = noisy(die.master, stream);
  die.slave = noisy(die.slave, stream);
  return die;
}

TEST(Adjustment, AFacetThatLeansTowardsBothNeighboursIsSuspectAndNoOther) {
  const SkewedDie die = noisy_die_of_known_shape();
  AdjustmentOptions options;
  options.shape = exact_shape(die.shape);
  const auto clean = adjust_die(two_scans(die), options);
  ASSERT_TRUE(clean);
  for (const FacetTest& test : clean->tests) EXPECT_FALSE(test.suspect);
  const auto& facets = die.slave.facets;
  const DieAdjustment found = adjusted_with_turned_facet(
      die, 1, 2 * deg, facets[0].fit.plane.normal + facets[2].fit.plane.normal);
  for (const FacetTest& test : found.tests)
    EXPECT_EQ(test.suspect, test.scan == 1 && test.pips == facets[1].pips)
        << test.scan << " " << test.pips << " " << test.statistic;
  EXPECT_GT(found.covariance_factor, 10);
}

TEST(Adjustment, AFacetThatLeansTowardsOneNeighbourLeavesBothSuspect) {
  const SkewedDie die = noisy_die_of_known_shape();
  const auto& facets = die.slave.facets;
  const DieAdjustment found =
      adjusted_with_turned_facet(die, 1, 2 * deg, facets[0].fit.plane.normal);
  for (const FacetTest& test : found.tests)
    EXPECT_EQ(test.suspect, test.scan == 1 && test.pips != facets[2].pips)
        << test.scan << " " << test.pips << " " << test.statistic;
}

TEST(Adjustment, LevelledScannersHelpTheRotation) {
  const SkewedDie die = [&] {
    SkewedDie drawn = skewed(90, 4, 0.4);
    RandomStream stream({6, 0, 0, 0, Purpose::test});
    drawn.master = noisy(drawn.master, stream);
    drawn.slave = noisy(drawn.slave, stream);
    return drawn;
  }();
  AdjustmentOptions options = free_with_edge(die);
  const auto plain = adjust_die(two_scans(die), options);
  options.level_sd_rad = 1e-6;
  const auto levelled = adjust_die(two_scans(die), options);
  ASSERT_TRUE(plain && levelled);
  const auto level_variance = [](const DieAdjustment& a) {
    return a.poses[1].covariance.covariance.diagonal().head<2>().sum();
  };
  EXPECT_LT(level_variance(*levelled), 0.1 * level_variance(*plain));
  EXPECT_EQ(levelled->freedom, plain->freedom + 2);
}

TEST(Adjustment, APlaneThatBothScansSeeGivesTheLength) {
  const SkewedDie die = skewed(90, 8);
  AdjustmentOptions options = free_with_edge(die);
  options.edges.clear();
  std::vector<AdjustmentScan> scans = two_scans(die);
  ASSERT_EQ(adjust_die(scans, options)->defect, 1);
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 0.5, 0.1).normalized();
  const Plane wall{normal, 4};
  const Plane in_slave{die.master_from_slave.rotation.transpose() * normal,
                       4 - normal.dot(die.master_from_slave.translation)};
  scans[0].planes = {{1, exact_fit(wall, {5, 1, 0})}};
  scans[1].planes = {
      {1, exact_fit(in_slave, die.master_from_slave.inverse() * Eigen::Vector3d(5.2, 0.7, 0.3))}};
  const auto found = adjust_die(scans, options);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->defect, 0);
  EXPECT_LT(pose_error(found->poses[1].master_from_scan, die).at_die_m, 1e-9);
}

TEST(Adjustment, ACalibratedShapeCarriesItsCovariance) {
  Ring stations = ring({45, 135, 225, 315}, 6);
  RandomStream stream({7, 0, 0, 0, Purpose::test});
  for (AdjustmentScan& scan : stations.scans) scan.die = noisy(scan.die, stream);
  AdjustmentOptions options;
  options.shape = free_shape(cube(0.5, Chirality::clockwise));
  options.edges = {{{1, 2}, edge_length_m(stations.shape, 1, 2).value(), 1e-4},
                   {{1, 3}, edge_length_m(stations.shape, 1, 3).value(), 1e-4}};
  const auto calibrated = adjust_die(stations.scans, options);
  ASSERT_TRUE(calibrated);
  EXPECT_EQ(calibrated->defect, 0);
  // The same shape, now given, for stations that share one facet only.
  AdjustmentOptions opposite;
  opposite.shape = calibrated_shape(calibrated->shape, calibrated->shape_covariance);
  std::vector<AdjustmentScan> pair{stations.scans[0], stations.scans[2]};
  for (AdjustmentScan& scan : pair) scan.die = noisy(scan.die, stream);
  const auto found = adjust_die(pair, opposite);
  ASSERT_TRUE(found) << found.refusal().message;
  EXPECT_EQ(found->defect, 0);
  const RigidTransform truth = stations.die_from_scan[0].inverse() * stations.die_from_scan[2];
  const TransformCovariance& covariance = found->poses[1].covariance;
  const Vector6d error =
      left_difference(truth, found->poses[1].master_from_scan, covariance.about_m);
  EXPECT_LT(error.dot(covariance.covariance.ldlt().solve(error)), 27.9);  // 99.99 %
  EXPECT_GT(covariance.covariance.diagonal().tail<3>().sum(), 1e-8);
}

}  // namespace
}  // namespace alea
