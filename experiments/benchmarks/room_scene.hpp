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

Room make_room(std::size_t points, std::uint64_t seed);
/// With seed 1, made once for each number of points.
const Room& room(std::size_t points);

/// How far a plane of 1,000 points or more is off.
struct PlaneError {
  std::size_t plane = 0;  ///< into Room::planes
  std::size_t points = 0;
  double fit_deg = 0;
  double ideal_deg = 0;   ///< of the orthogonal fit to exactly the true points
  double own_sd_deg = 0;  ///< that the true points allow: standard deviation of the angle
};

/// How well sets of points recover the true planes.
struct Recovery {
  std::size_t planes = 0;  ///< true ones with at least `least` points
  std::size_t found = 0;   ///< of these, with an intersection over union above 0.5
  /// Normal against truth, of planes found that have 1,000 points or more; of all of them, and of
  /// those whose true points alone give a fit within 0.02 deg.
  double worst_deg = 0;
  double worst_determined_deg = 0;
  double worst_ideal_deg = 0;  ///< of the fits to exactly the true points
  std::vector<PlaneError> errors;
};
/// `normals` of the sets where the method gives them; empty: by least squares of the sets.
Recovery recovery(const Room& room, const std::vector<std::vector<std::uint32_t>>& sets,
                  std::size_t least, const std::vector<Eigen::Vector3d>& normals = {});

}  // namespace alea::benchmarks
