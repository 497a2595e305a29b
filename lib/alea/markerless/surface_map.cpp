#include "alea/markerless/surface_map.hpp"

#include <cmath>

namespace alea {
namespace {

constexpr double most_cells = 8e6;

/// Of the 26 neighbours in a cube, the one that a direction points to.
std::uint32_t facing_of(const Eigen::Vector3d& direction) {
  std::uint32_t index = 0;
  for (int k = 0; k < 3; ++k) {
    const double part = direction[k];
    index = 3 * index + (part > 0.383 ? 2U : part < -0.383 ? 0U : 1U);
  }
  return index;
}

/// For each such direction the bits of those within 46 deg of it: its neighbours.
std::array<std::uint32_t, 27> near_directions() {
  std::array<std::uint32_t, 27> near{};
  const auto direction = [](std::uint32_t index) {
    return Eigen::Vector3d(static_cast<double>(index / 9) - 1,
                           static_cast<double>(index / 3 % 3) - 1,
                           static_cast<double>(index % 3) - 1)
        .normalized();
  };
  for (std::uint32_t a = 0; a < 27; ++a)
    for (std::uint32_t b = 0; b < 27; ++b)
      if (a != 13 && b != 13 && direction(a).dot(direction(b)) > 0.69) near[a] |= 1U << b;
  return near;
}

}  // namespace

SurfaceMap::SurfaceMap(const Cloud& cloud, double cell_m) : cell_m_(cell_m) {
  if (cloud.empty()) return;
  Eigen::Vector3d most = cloud.positions[0];
  least_m_ = most;
  for (const Eigen::Vector3d& p : cloud.positions) {
    least_m_ = least_m_.cwiseMin(p);
    most = most.cwiseMax(p);
  }
  const Eigen::Vector3d extent = most - least_m_;
  const auto cells_along = [&](int axis) { return std::floor(extent[axis] / cell_m_) + 3; };
  while (cells_along(0) * cells_along(1) * cells_along(2) > most_cells) cell_m_ *= 1.25;
  for (int k = 0; k < 3; ++k)
    cells_[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(cells_along(k));
  least_m_ -= Eigen::Vector3d::Constant(cell_m_);  // an empty layer all around
  facing_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), 0);
  static const std::array<std::uint32_t, 27> near = near_directions();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t bits = near[facing_of(cloud.normals[i].cast<double>())];
    const Eigen::Vector3d at = (cloud.positions[i] - least_m_) / cell_m_;
    std::array<std::int64_t, 3> low{};
    for (int k = 0; k < 3; ++k)
      low[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(at[k] - 0.5));
    for (int corner = 0; corner < 8; ++corner) {
      const std::int64_t x = low[0] + (corner & 1), y = low[1] + (corner >> 1 & 1),
                         z = low[2] + (corner >> 2);
      facing_[static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x)] |= bits;
    }
  }
}

bool SurfaceMap::has(const Eigen::Vector3d& place_m, const Eigen::Vector3d& normal) const {
  std::array<std::int64_t, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    cell[axis] = static_cast<std::int64_t>(std::floor((place_m[k] - least_m_[k]) / cell_m_));
    if (cell[axis] < 0 || cell[axis] >= cells_[axis]) return false;
  }
  const std::uint32_t bits =
      facing_[static_cast<std::size_t>((cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0])];
  return (bits >> facing_of(normal) & 1U) != 0;
}

}  // namespace alea
