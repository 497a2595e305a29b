#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/named_scenes.hpp"

namespace alea::benchmarks {

/// The furnished room with about this many points, and the true plane of each point: coplanar
/// rectangles that touch count as one plane.
struct Room {
  testing::LabelledScan scan;
  std::vector<testing::Rectangle> planes;
};

/// Made once for each number of points.
const Room& room(std::size_t points);

/// How well sets of points recover the true planes.
struct Recovery {
  std::size_t planes = 0;  ///< true ones with at least `least` points
  std::size_t found = 0;   ///< of these, with an intersection over union above 0.5
  /// Normal against truth, of planes found that have 1,000 points or more; of all of them, and of
  /// those whose true points alone give a fit within 0.02 deg.
  double worst_deg = 0;
  double worst_determined_deg = 0;
  double worst_ideal_deg = 0;  ///< of the fits to exactly the true points
};
/// `normals` of the sets where the method gives them; empty: by least squares of the sets.
Recovery recovery(const Room& room, const std::vector<std::vector<std::uint32_t>>& sets,
                  std::size_t least, const std::vector<Eigen::Vector3d>& normals = {});

}  // namespace alea::benchmarks
