#include "alea/markerless/height_vote.hpp"

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

constexpr double cell_m = 0.5, bin_m = 0.1;

}  // namespace

std::vector<HeightVote::Level> HeightVote::levels_of(const PreparedScan& scan) {
  std::vector<Level> levels;
  for (std::size_t i = 0; i < scan.coarse.size(); ++i) {
    const Eigen::Vector3d n = scan.upright_from_scan * scan.coarse.normals[i].cast<double>();
    if (std::abs(n.z()) < 0.85) continue;
    const Eigen::Vector3d p = scan.upright_from_scan * scan.coarse.positions[i];
    levels.push_back({p.head<2>(), p.z(), n.z() > 0});
  }
  return levels;
}

std::array<int, 3> HeightVote::cell_of(const Eigen::Vector2d& place_m, bool up) {
  return {static_cast<int>(std::floor(place_m.x() / cell_m)),
          static_cast<int>(std::floor(place_m.y() / cell_m)), up ? 1 : 0};
}

HeightVote::HeightVote(const PreparedScan& fixed, const PreparedScan& moving, double range_m)
    : range_m_(range_m), moving_(levels_of(moving)) {
  for (const Level& level : levels_of(fixed))
    fixed_heights_[cell_of(level.place_m, level.up)].push_back(level.height_m);
}

std::vector<double> HeightVote::best(double yaw_rad, const Eigen::Vector2d& shift_m) const {
  const int bins = 2 * static_cast<int>(std::ceil(range_m_ / bin_m)) + 1;
  std::vector<int> votes(static_cast<std::size_t>(bins) + 2, 0);  // with an empty bin at each end
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const std::size_t stride = std::max<std::size_t>(1, moving_.size() / 600);
  for (std::size_t i = 0; i < moving_.size(); i += stride) {
    const Level& level = moving_[i];
    const Eigen::Vector2d place(c * level.place_m.x() - s * level.place_m.y() + shift_m.x(),
                                s * level.place_m.x() + c * level.place_m.y() + shift_m.y());
    const auto heights = fixed_heights_.find(cell_of(place, level.up));
    if (heights == fixed_heights_.end()) continue;
    for (const double height : heights->second) {
      const int bin = static_cast<int>(std::floor((height - level.height_m + range_m_) / bin_m));
      if (bin >= 0 && bin < bins) ++votes[static_cast<std::size_t>(bin) + 1];
    }
  }
  const auto smooth = [&](int bin) {
    const auto b = static_cast<std::size_t>(bin) + 1;
    return votes[b - 1] + 2 * votes[b] + votes[b + 1];
  };
  const auto height = [&](int bin) { return (bin + 0.5) * bin_m - range_m_; };
  int first = -1, second = -1;
  for (int bin = 0; bin < bins; ++bin)
    if (smooth(bin) > (first < 0 ? 0 : smooth(first))) first = bin;
  if (first < 0) return {0.0};
  for (int bin = 0; bin < bins; ++bin)
    if (std::abs(bin - first) > 2 &&
        smooth(bin) > (second < 0 ? smooth(first) / 2 : smooth(second)))
      second = bin;
  if (second < 0) return {height(first)};
  return {height(first), height(second)};
}

}  // namespace alea
