#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace alea {

/// What a ray can hit. Positions in the scene's arrays of the same name.
enum class SurfaceKind : std::uint8_t { die, patch, box, cylinder, sphere, checkerboard, mesh };

/// Names the surface that a point lies on.
struct SurfaceId {
  SurfaceKind kind = SurfaceKind::die;
  std::uint32_t index = 0;
  /// Die: pips 1 to 6, 0 on a rounded edge. Box: 1 to 6 for -x, +x, -y, +y, -z, +z. Cylinder: 0
  /// mantle, 1 base, 2 top. Else 0.
  std::uint8_t facet = 0;
};

/// Scene frame; the direction has unit length.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  Eigen::Vector3d at(double range_m) const { return origin + range_m * direction; }
};

/// The nearest surface so far along a ray.
struct Hit {
  double range_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit length, either side
  double intensity = 0;
  SurfaceId surface;
};

}  // namespace alea
