#include "alea/facet/facet_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/plane/plane_detector.hpp"
#include "alea/simulate/scene.hpp"
#include "tests/facet/angle_between.hpp"
#include "tests/support/die_scan.hpp"

namespace alea {
namespace {

using test::die_facets_of;
using test::DieScan;
using test::scan_die;

FacetFitOptions at_origin() {
  FacetFitOptions options;
  options.fit.scanner_position = Eigen::Vector3d::Zero();
  return options;
}

DieScan scan_with_radius(double radius_m) {
  DieModel model;
  model.edge_radius_m = radius_m;
  return scan_die(model, 4, 1.5e-3);
}

TEST(FacetFit, FindsTheFacetsOfARoundedDieWithoutTheirBorders) {
  for (const double radius : {0.0, 0.02, 0.03}) {
    const DieScan scan = scan_with_radius(radius);
    const auto result = fit_facets(scan.cloud, die_facets_of(scan), at_origin());
    ASSERT_TRUE(result) << result.refusal().message;
    EXPECT_NEAR(result->edge_radius_m, radius, 0.003);
    EXPECT_GE(result->trim_m, radius - 0.003);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(angle_rad(result->fits[k].plane.normal, scan.planes[k].normal), 8e-4) << radius;
      EXPECT_NEAR(result->fits[k].variance_factor, 1, 0.12) << radius;
      EXPECT_NEAR(scan.planes[k].signed_distance(result->fits[k].centroid_m), 0, 2e-4) << radius;
      EXPECT_NEAR(result->edges_m[k], 0.5, 0.015) << radius;
      EXPECT_LT(std::abs(result->edges_m[k] - 0.5), 4 * result->edges_sd_m[k]) << radius;
    }
  }
}

TEST(FacetFit, SidesSeenFromAboveAreHardlyLongerThanTheyAre) {
  const DieScan scan = scan_die({}, 4, 8e-4);
  FacetFitOptions point_beam = at_origin();
  point_beam.footprint_m = 0;
  point_beam.edge_radius_m = 0.0;
  const auto result = fit_facets(scan.cloud, die_facets_of(scan), point_beam);
  ASSERT_TRUE(result) << result.refusal().message;
  // It was 9 mm without the cosine of the elevation.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(result->edges_m[k], 0.5, 0.007);
}

TEST(FacetFit, UntrimmedRoundedEdgesTiltTheFacets) {
  const DieScan scan = scan_with_radius(0.03);
  FacetFitOptions untrimmed = at_origin();
  untrimmed.trim_m = 0;
  const auto result = fit_facets(scan.cloud, die_facets_of(scan), untrimmed);
  ASSERT_TRUE(result);
  EXPECT_GT(angle_rad(result->fits[0].plane.normal, scan.planes[0].normal), 1.2e-3);
}

/// How far a facet leans towards the scanner, in standard deviations.
double lean_in_sds(const PlaneFit& fit, const Plane& truth) {
  const Eigen::Vector2d towards = (-fit.tangent.transpose() * fit.centroid_m).normalized();
  const Eigen::Vector2d lean = fit.tangent.transpose() * (fit.plane.normal - truth.normal);
  const Eigen::Matrix2d covariance = fit.covariance.topLeftCorner<2, 2>();
  return towards.dot(lean) / std::sqrt(towards.dot(covariance * towards));
}

// Pointing noise eight times the usual, the upper facet at 84 deg: rays at its silhouette are
// measured only where they were off towards it. Without trim the fit leans by many standard
// deviations unless it knows of the pointing.
TEST(FacetFit, PointingAtTheBordersDoesNotLeanAGrazingFacet) {
  Scanner scanner;
  scanner.noise.angular_noise_rad *= 8;
  const DieScan scan = scan_die({}, 12, 2.5e-4, {}, 0, scanner);
  FacetFitOptions options = at_origin();
  options.trim_m = 0;
  options.fit.noise = scanner.noise;
  const auto careful = fit_facets(scan.cloud, die_facets_of(scan), options);
  options.fit.noise.angular_noise_rad = 0;
  const auto careless = fit_facets(scan.cloud, die_facets_of(scan), options);
  ASSERT_TRUE(careful && careless);
  EXPECT_LT(std::abs(lean_in_sds(careful->fits[0], scan.planes[0])), 3);
  EXPECT_GT(lean_in_sds(careless->fits[0], scan.planes[0]), 4);
  EXPECT_LT(careful->fits[0].points, careless->fits[0].points);
}

TEST(FacetFit, ABandWithoutTheNearestPlaneTestSwallowsTheNeighbours) {
  const DieScan scan = scan_with_radius(0);
  FacetFitOptions naive = at_origin();
  naive.fit.method = FitMethod::orthogonal;
  naive.nearest_plane = false;
  naive.gate_m = 0.01;
  naive.trim_m = -0.01;
  const auto result = fit_facets(scan.cloud, die_facets_of(scan), naive);
  ASSERT_TRUE(result);
  EXPECT_GT(angle_rad(result->fits[0].plane.normal, scan.planes[0].normal), 2e-3);
  naive.nearest_plane = true, naive.gate_m.reset(), naive.trim_m.reset();
  const auto careful = fit_facets(scan.cloud, die_facets_of(scan), naive);
  ASSERT_TRUE(careful);
  EXPECT_LT(angle_rad(careful->fits[0].plane.normal, scan.planes[0].normal), 8e-4);
}

TEST(FacetFit, MovingCloudAndScannerFarAwayKeepsPointsAndPlanes) {
  const DieScan scan = scan_with_radius(0.02);
  const auto near = fit_facets(scan.cloud, die_facets_of(scan), at_origin());
  DieScan moved = scan;
  const Eigen::Vector3d far(5e5, -3e5, 5e5);
  for (Eigen::Vector3d& p : moved.cloud.positions) p += far;
  for (Plane& plane : moved.planes) plane.offset_m += plane.normal.dot(far);
  moved.cloud.scanner_position = far;
  FacetFitOptions options = at_origin();
  options.fit.scanner_position = far;
  const auto result = fit_facets(moved.cloud, die_facets_of(moved), options);
  ASSERT_TRUE(near && result);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(angle_rad(near->fits[k].plane.normal, result->fits[k].plane.normal), 1e-9);
    EXPECT_LT((result->fits[k].centroid_m - far - near->fits[k].centroid_m).norm(), 1e-6);
  }
}

TEST(FacetFit, AnyOrderOfTheCloudGivesTheSameBits) {
  const DieScan scan = scan_with_radius(0.01);
  DieScan turned = scan;
  std::reverse(turned.cloud.positions.begin(), turned.cloud.positions.end());
  const auto a = fit_facets(scan.cloud, die_facets_of(scan), at_origin());
  auto regions = die_facets_of(scan);
  for (PlaneRegion& region : regions) {
    for (std::uint32_t& i : region.indices)
      i = static_cast<std::uint32_t>(scan.cloud.size()) - 1 - i;
    std::sort(region.indices.begin(), region.indices.end());
  }
  const auto b = fit_facets(turned.cloud, regions, at_origin());
  ASSERT_TRUE(a && b);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(a->fits[k].plane.normal, b->fits[k].plane.normal);
    EXPECT_EQ(a->fits[k].plane.offset_m, b->fits[k].plane.offset_m);
    EXPECT_EQ(a->fits[k].covariance, b->fits[k].covariance);
    EXPECT_EQ(a->edges_m[k], b->edges_m[k]);
  }
}

TEST(FacetFit, FewPointsAreRefusedAndPipsCanBeMasked) {
  DieModel model;
  model.pips.recess_m = 0.003;
  const DieScan scan = scan_die(model, 4, 1.5e-3);
  const auto plain = fit_facets(scan.cloud, die_facets_of(scan), at_origin());
  ASSERT_TRUE(plain);
  FacetFitOptions masked = at_origin();
  for (int k = 0; k < 3; ++k)
    masked.masks[k] = pip_discs(scan.pips[k], plain->extents[k].border_m, 0.05);
  const auto result = fit_facets(scan.cloud, die_facets_of(scan), masked);
  ASSERT_TRUE(result);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(result->fits[k].points, plain->fits[k].points);
    EXPECT_LT(std::abs(scan.planes[k].signed_distance(result->fits[k].centroid_m)), 2e-4);
  }
  masked.min_points = 100000;
  const auto refused = fit_facets(scan.cloud, die_facets_of(scan), masked);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.refusal().code, RefusalCode::too_few_points);
}

// The share of R that the touching ray hides, at head-on, 45 and grazing incidence.
TEST(FacetFit, AGrazingSideWhoseColumnsLieFarApartIsMeasuredToItsEnd) {
  for (const double turn_deg : {32.0, 33.0, 34.0, 35.0, 36.0, 37.0}) {
    DieModel model;
    model.scene_from_die.rotation =
        Eigen::AngleAxisd(turn_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    const DieScan scan = scan_die(model, 4, 1.7e-3);
    const auto result = fit_facets(scan.cloud, die_facets_of(scan), at_origin());
    ASSERT_TRUE(result) << result.refusal().message;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(result->edges_m[k], 0.5, 0.03) << turn_deg;
      EXPECT_LT(std::abs(result->edges_m[k] - 0.5), 4 * result->edges_sd_m[k]) << turn_deg;
    }
  }
}

TEST(FacetFit, RoundedCoordinatesLeaveNoFacetExact) {
  // The scanner is level: the upper facet's heights are all the same multiple, or two of them.
  for (const double step_m : {0.001, 0.002}) {
    DieScan scan = scan_with_radius(0);
    for (Eigen::Vector3d& p : scan.cloud.positions) p = (p / step_m).array().round() * step_m;
    const auto result = fit_facets(scan.cloud, die_facets_of(scan), at_origin());
    ASSERT_TRUE(result) << result.refusal().message;
    for (int k = 0; k < 3; ++k) {
      const PlaneFit& fit = result->fits[k];
      EXPECT_GT(fit.points, 100u);
      const Eigen::Vector3d sd = fit.covariance.diagonal().cwiseSqrt();
      EXPECT_GT(sd.minCoeff(), 1e-6) << step_m;
      EXPECT_LT(angle_rad(fit.plane.normal, scan.planes[k].normal), 5 * sd.head<2>().norm())
          << step_m;
      EXPECT_LT(std::abs(scan.planes[k].signed_distance(fit.centroid_m)), 5 * sd[2]);
    }
  }
}

TEST(FacetExtent, HiddenShareOfARounding) {
  EXPECT_NEAR(hidden_share(0), 0, 1e-12);
  EXPECT_NEAR(hidden_share(std::numbers::pi / 4), 0.5858, 1e-4);
  EXPECT_NEAR(hidden_share(1.396), 0.9128, 2e-3);
}

}  // namespace
}  // namespace alea
