#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "alea/checkerboard/board_plane.hpp"

namespace alea {

/// A plane through points that are mostly not on it: the three-point plane whose slab explains the
/// points best, over slabs of half thickness 0.003 to 0.15 `side_m` against points spread over the
/// crop. Empty where no slab does. The numbers of the random stream are the same at every call.
struct RoughPlane {
  Plane plane;
  double half_thickness_m = 0;
  std::vector<std::uint32_t> members;  ///< within three half thicknesses, ascending
};
std::optional<RoughPlane> find_rough_plane(const BoardPoints& points, double side_m);

}  // namespace alea
