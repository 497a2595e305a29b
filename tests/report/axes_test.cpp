#include "alea/report/axes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "alea/report/view.hpp"
#include "tests/support/png.hpp"

namespace alea {
namespace {

TEST(Axes, TicksAreRoundAndInside) {
  EXPECT_EQ(round_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  const std::vector<double> ticks = round_ticks(-0.13, 0.21, 4);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_NEAR(ticks.front(), -0.1, 1e-12);
  EXPECT_NEAR(ticks.back(), 0.2, 1e-12);
  EXPECT_TRUE(round_ticks(1, 1, 5).empty());
}

TEST(Axes, PlacesAndPixelsAreInverseAndUpIsUp) {
  Canvas canvas(400, 300);
  const Axes axes(canvas, {0, 0, 400, 300}, {.low = {-1, 2}, .high = {3, 4}});
  const Eigen::Vector2d place(0.7, 3.1);
  EXPECT_LT((axes.place(axes.at(place)) - place).norm(), 1e-12);
  EXPECT_GT(axes.at({1, 4}).x(), axes.at({0, 4}).x());
  EXPECT_LT(axes.at({1, 4}).y(), axes.at({1, 3}).y());
}

TEST(Axes, EqualScaleKeepsRightAngles) {
  Canvas canvas(400, 200);
  const Axes axes(canvas, {0, 0, 400, 200}, {.low = {0, 0}, .high = {1, 5}});
  const Eigen::Vector2d origin = axes.at({0, 0});
  EXPECT_NEAR((axes.at({1, 0}) - origin).norm(), (axes.at({0, 1}) - origin).norm(), 1e-9);
  EXPECT_LE(axes.low().y(), 0);
  EXPECT_GE(axes.high().y(), 5);
}

TEST(Axes, APointOffThePanelIsNotDrawn) {
  Canvas canvas(200, 200);
  Axes axes(canvas, {0, 0, 200, 200}, {.low = {0, 0}, .high = {1, 1}});
  const Picture before = canvas.picture();
  axes.point({40, 0.5}, colours::slave, 5);
  EXPECT_EQ(canvas.picture().samples, before.samples);
  axes.point({0.5, 0.5}, colours::slave, 5);
  EXPECT_GT(testing::colour_share(canvas.picture(), colours::slave), 0.001);
}

TEST(Canvas, AnUprightTextLeavesTheRestOfTheSheetAlone) {
  Canvas canvas(120, 80);
  canvas.disc({100, 40}, 6, colours::master);
  canvas.text({10, 40}, "y (m)", {.anchor = TextAnchor::centre, .upright = true});
  EXPECT_EQ(canvas.width(), 120);
  EXPECT_EQ(canvas.picture().at(100, 40), colours::master);
  EXPECT_EQ(canvas.picture().at(60, 40), colours::white);
  EXPECT_LT(testing::colour_share(canvas.picture(), colours::white), 0.985);
}

TEST(ParallelView, IsRightHandedAndKeepsZUpright) {
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(1, 2, 0.5), Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(-1, 0, -0.2)}) {
    const ParallelView view = view_from(from);
    EXPECT_LT((view.right.cross(view.up) - view.to_viewer).norm(), 1e-12);
    EXPECT_GE(view(Eigen::Vector3d::UnitZ()).y(), 0);
  }
  EXPECT_LT((view_from({0, 0, 1})(Eigen::Vector3d(2, 3, 9)) - Eigen::Vector2d(2, 3)).norm(), 1e-12);
}

TEST(ParallelView, NearerPointsCoverFartherOnes) {
  Canvas canvas(60, 60);
  Axes axes(canvas, {0, 0, 60, 60}, {.low = {-1, -1}, .high = {1, 1}, .frame = false});
  const std::vector<Eigen::Vector3d> points{{0, 0, 5}, {0, 0, 1}};
  const std::vector<Rgb> colours{colours::slave, colours::master};
  draw_points(axes, view_from({0, 0, 1}), points, colours, 4);
  const Eigen::Vector2d centre = axes.at({0, 0});
  EXPECT_EQ(canvas.picture().at(static_cast<int>(centre.x()), static_cast<int>(centre.y())),
            colours::slave);
}

}  // namespace
}  // namespace alea
