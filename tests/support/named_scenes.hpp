#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/plane.hpp"

namespace alea::testing {

/// A rectangle in space: corner + s * side_a + t * side_b, s and t in [0, 1]; sides at right
/// angles.
struct Rectangle {
  Eigen::Vector3d corner;
  Eigen::Vector3d side_a;
  Eigen::Vector3d side_b;
};

/// The six or fewer rectangles of a box that rests on `base` (centre of its floor), turned about z.
std::vector<Rectangle> box_sides(const Eigen::Vector3d& base, const Eigen::Vector3d& size,
                                 double turn_rad, bool with_bottom = false);

/// 8 x 6 x 3 m with a door recess, a niche, a turned box, a partition and a ramp: 23 rectangles.
std::vector<Rectangle> furnished_room();

struct ScanOptions {
  Eigen::Vector3d scanner = Eigen::Vector3d::Zero();
  double step_rad = 0.01;  ///< of azimuth and elevation
  double range_noise_m = 0.0015;
  std::uint64_t seed = 1;
  /// Only the angular window that a ball of this radius about `window` fills; 0 = all round.
  Eigen::Vector3d window = Eigen::Vector3d::Zero();
  double window_radius_m = 0;
};

/// What a scanner sees of rectangles, with the rectangle that each point lies on.
struct LabelledScan {
  Cloud cloud;
  std::vector<int> rectangle;  ///< for each point
};

/// A scan at equal angular steps with normal range noise.
LabelledScan scan_rectangles(const std::vector<Rectangle>& scene, const ScanOptions& options);

/// Three facets of a cube of this edge that faces the scanner, `range_m` away and `drop_m` below
/// the scanner, alone.
LabelledScan cube_scan(double edge_m, double range_m, double drop_m, double step_rad,
                       std::uint64_t seed = 1);

/// Points in another order, and the place that each came from.
struct Shuffled {
  Cloud cloud;
  std::vector<std::uint32_t> origin;
};
Shuffled shuffled(const Cloud& cloud, std::uint64_t seed);

}  // namespace alea::testing
