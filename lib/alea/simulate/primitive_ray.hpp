#pragma once

#include <limits>

#include "alea/simulate/ray.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// Range of a ray that meets nothing.
inline constexpr double never_m = std::numeric_limits<double>::infinity();

/// Each moves `hit` to where the ray meets the object, if that is nearer and in front of the
/// origin. Solids are seen from outside, patches from both sides.
void intersect(const Patch& patch, std::uint32_t index, const Ray& ray, Hit& hit);
void intersect(const Box& box, std::uint32_t index, const Ray& ray, Hit& hit);
void intersect(const Cylinder& cylinder, std::uint32_t index, const Ray& ray, Hit& hit);
void intersect(const Sphere& sphere, std::uint32_t index, const Ray& ray, Hit& hit);
void intersect(const Checkerboard& board, std::uint32_t index, const Ray& ray, Hit& hit);

/// Range (m) at which the line of the ray enters a ball; infinity where it misses.
double enter_ball(const Ray& ray, const Eigen::Vector3d& centre_m, double radius_m);

/// Range (m) at which the line of the ray enters the points within radius_m of the segment a b;
/// infinity where it misses.
double enter_capsule(const Ray& ray, const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m,
                     double radius_m);

}  // namespace alea
