#pragma once

#include <Eigen/Core>
#include <span>

namespace alea {

/// The step to which the coordinates of points were rounded (m): the largest of 1, 2 and 5 times
/// powers of ten from 0.2 mm to 1 m, and of powers of two from 2^-10 m (single precision far from
/// the origin), that every coordinate is a multiple of. Zero where there is none, and for fewer
/// than 30 points.
double coordinate_step_m(std::span<const Eigen::Vector3d> points);

}  // namespace alea
