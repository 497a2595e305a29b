#include "alea/cloud/coordinate_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

std::vector<Eigen::Vector3d> points_about(double offset_m, double step_m) {
  RandomStream stream({1, 0, 0, 0, Purpose::test});
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 300; ++i) {
    Eigen::Vector3d p(stream.uniform(), stream.uniform(), stream.uniform());
    p = p * 10 + Eigen::Vector3d::Constant(offset_m);
    if (step_m > 0) p = (p / step_m).array().round() * step_m;
    points.push_back(p);
  }
  return points;
}

TEST(CoordinateStep, IsFoundNearAndFarFromTheOrigin) {
  for (const double offset_m : {0.0, -3.0, 5e5})
    for (const double step_m : {0.001, 0.002, 0.005, 0.01})
      EXPECT_EQ(coordinate_step_m(points_about(offset_m, step_m)), step_m) << offset_m;
}

TEST(CoordinateStep, SinglePrecisionShowsItsOwn) {
  std::vector<Eigen::Vector3d> points = points_about(5e6, 0);
  for (Eigen::Vector3d& p : points) p = p.cast<float>().cast<double>();
  EXPECT_EQ(coordinate_step_m(points), 0.5);
  points = points_about(0, 0.001);
  for (Eigen::Vector3d& p : points) p = p.cast<float>().cast<double>();
  EXPECT_EQ(coordinate_step_m(points), 0.001);
}

TEST(CoordinateStep, MeasuredCoordinatesAndHandfulsOfPointsHaveNone) {
  EXPECT_EQ(coordinate_step_m(points_about(2, 0)), 0);
  EXPECT_EQ(coordinate_step_m(std::vector<Eigen::Vector3d>(5, {1, 2, 3})), 0);
}

}  // namespace
}  // namespace alea
