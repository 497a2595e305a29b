#include "alea/markerless/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace alea {
namespace {

using std::numbers::pi;
constexpr float nothing = std::numeric_limits<float>::infinity();

}  // namespace

RangeImage::RangeImage(const Cloud& cloud, const Eigen::Vector3d& origin_m, double cell_rad)
    : origin_m_(origin_m),
      cell_rad_(cell_rad),
      columns_(static_cast<std::size_t>(std::ceil(2 * pi / cell_rad))),
      rows_(static_cast<std::size_t>(std::ceil(pi / cell_rad))),
      nearest_m_(columns_ * rows_, nothing) {
  for (const Eigen::Vector3d& p : cloud.positions) {
    const Eigen::Vector3d d = p - origin_m;
    float& nearest = nearest_m_[cell_of(d)];
    nearest = std::min(nearest, static_cast<float>(d.norm()));
  }
  widen_near_surfaces();
}

void RangeImage::widen_near_surfaces() {
  const std::vector<float> before = nearest_m_;
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column) {
      float& nearest = nearest_m_[row * columns_ + column];
      if (nearest == nothing) continue;
      for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows_ - 1); ++r)
        for (const std::size_t turn : {columns_ - 1, std::size_t{0}, std::size_t{1}})
          nearest = std::min(nearest, before[r * columns_ + (column + turn) % columns_]);
    }
}

std::size_t RangeImage::cell_of(const Eigen::Vector3d& d) const {
  const double azimuth = std::atan2(d.y(), d.x()) + pi;
  const double elevation = std::atan2(d.z(), std::hypot(d.x(), d.y())) + pi / 2;
  const std::size_t column = std::min(columns_ - 1, static_cast<std::size_t>(azimuth / cell_rad_));
  const std::size_t row = std::min(rows_ - 1, static_cast<std::size_t>(elevation / cell_rad_));
  return row * columns_ + column;
}

std::optional<double> RangeImage::free_range_m(const Eigen::Vector3d& place_m) const {
  const float range = nearest_m_[cell_of(place_m - origin_m_)];
  if (range == nothing) return std::nullopt;
  return range;
}

bool RangeImage::is_in_free_space(const Eigen::Vector3d& place_m, double margin_m) const {
  const Eigen::Vector3d d = place_m - origin_m_;
  const float range = nearest_m_[cell_of(d)];
  return range != nothing && d.norm() < range - margin_m;
}

}  // namespace alea
