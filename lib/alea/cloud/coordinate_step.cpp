#include "alea/cloud/coordinate_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace alea {
namespace {

constexpr std::array<double, 21> steps_m{
    1,          0.5,     0.25,        0.2,      0.125,        0.1,       0.0625,
    0.05,       0.03125, 0.02,        0.015625, 0.01,         0.0078125, 0.005,
    0.00390625, 0.002,   0.001953125, 0.001,    0.0009765625, 0.0005,    0.0002};
constexpr std::size_t least_points = 30;

bool is_multiple(double value, double step) {
  const double steps = value / step;
  // A decimal number in single precision is off by up to 6e-8 of itself.
  const double slack = 1e-6 + std::min(0.01, std::abs(steps) * 1.2e-7);
  return std::abs(steps - std::round(steps)) <= slack;
}

}  // namespace

double coordinate_step_m(std::span<const Eigen::Vector3d> points) {
  if (points.size() < least_points) return 0;
  for (const double step : steps_m) {
    bool all = true;
    for (std::size_t i = 0; all && i < points.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) all = all && is_multiple(points[i][axis], step);
    if (all) return step;
  }
  return 0;
}

}  // namespace alea
