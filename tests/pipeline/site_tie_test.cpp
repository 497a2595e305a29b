#include "alea/pipeline/site_tie.hpp"

#include <gtest/gtest.h>

#include "alea/core/error.hpp"

namespace alea {
namespace {

const RigidTransform truth{rotation_exp({0.1, -0.2, 0.9}), {5e5, 4e6, 120}};

std::vector<NamedPoint> measured_points() {
  return {{"A", {0, 0, 0}, {}}, {"B", {10, 0, 1}, {}}, {"C", {3, 8, 0}, {}}, {"D", {6, 6, 3}, {}}};
}

std::vector<NamedPoint> site_points() {
  std::vector<NamedPoint> site = measured_points();
  for (NamedPoint& point : site) point.point_m = truth * point.point_m;
  return site;
}

TEST(SiteTie, FindsTheSiteFarFromItsOrigin) {
  std::vector<NamedPoint> site = site_points();
  std::reverse(site.begin(), site.end());  // names decide, not order
  site.push_back({"unseen", {0, 0, 0}, {}});
  const auto tie = tie_to_site(site, measured_points());
  ASSERT_TRUE(tie) << tie.refusal().message;
  EXPECT_EQ(tie->points.size(), 4u);
  EXPECT_LT((tie->site_from_master.rotation - truth.rotation).norm(), 1e-8);
  EXPECT_LT(
      (tie->site_from_master * Eigen::Vector3d(5, 4, 1) - truth * Eigen::Vector3d(5, 4, 1)).norm(),
      1e-7);
  EXPECT_LT(tie->rmse_m, 1e-7);
}

TEST(SiteTie, ResidualsPointAtTheWrongCoordinate) {
  std::vector<NamedPoint> site = site_points();
  site[2].point_m.z() += 0.05;
  const auto tie = tie_to_site(site, measured_points());
  ASSERT_TRUE(tie);
  const auto worst = std::max_element(
      tie->points.begin(), tie->points.end(),
      [](const auto& a, const auto& b) { return a.residual_m.norm() < b.residual_m.norm(); });
  EXPECT_GT(worst->residual_m.norm(), 0.005);
  EXPECT_GT(tie->covariance.covariance.trace(), 1e-6);
}

TEST(SiteTie, GivenDeviationsMakeTheCovariance) {
  std::vector<NamedPoint> site = site_points(), measured = measured_points();
  for (NamedPoint& point : site) point.sd_m = 0.003;
  for (NamedPoint& point : measured) point.sd_m = 0.004;
  const auto tie = tie_to_site(site, measured);
  ASSERT_TRUE(tie);
  // Four points with 5 mm in each coordinate, about their mean.
  for (int k = 3; k < 6; ++k)
    EXPECT_NEAR(tie->covariance.covariance(k, k), 0.005 * 0.005 / 4, 1e-12);
}

TEST(SiteTie, TooFewPointsAndPointsOnALineAreRefused) {
  std::vector<NamedPoint> two = site_points();
  two.resize(2);
  EXPECT_EQ(tie_to_site(two, measured_points()).refusal().code, RefusalCode::too_few_points);
  std::vector<NamedPoint> line{{"A", {0, 0, 0}, {}}, {"B", {1, 0, 0}, {}}, {"C", {4, 0, 0}, {}}};
  EXPECT_EQ(tie_to_site(line, line).refusal().code, RefusalCode::collinear);
}

TEST(SiteTie, ANameThatOccursTwiceIsBadInput) {
  std::vector<NamedPoint> site = site_points();
  site[1].name = "A";
  EXPECT_THROW(tie_to_site(site, measured_points()), Error);
}

}  // namespace
}  // namespace alea
