#include "alea/markerless/symmetry_axis.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/markerless/wall_correlation.hpp"

namespace alea {
namespace {

constexpr std::array<double, 8> turns_deg{45, -45, 60, -60, 90, -90, 120, -120};
constexpr int shifts_per_turn = 6;
constexpr double together_m = 0.6;

/// The fixed points of all shifts, turn by turn.
std::vector<SymmetryAxis> fixed_points(const PreparedScan& scan) {
  const WallCorrelation walls(scan, scan, {});
  std::array<std::vector<SymmetryAxis>, turns_deg.size()> of_turn;
  parallel_chunks(turns_deg.size(), 1, [&](std::size_t k, std::size_t) {
    const double turn = turns_deg[k] * deg;
    const Eigen::Matrix2d away =
        Eigen::Matrix2d::Identity() - Eigen::Rotation2Dd(turn).toRotationMatrix();
    for (const WallShift& wall : walls.best(turn, shifts_per_turn))
      of_turn[k].push_back({away.inverse() * wall.shift_m, wall.score});
  });
  std::vector<SymmetryAxis> points;
  for (const auto& part : of_turn) points.insert(points.end(), part.begin(), part.end());
  return points;
}

}  // namespace

std::vector<SymmetryAxis> symmetry_axes(const PreparedScan& scan, std::size_t count) {
  const std::vector<SymmetryAxis> points = fixed_points(scan);
  std::vector<SymmetryAxis> axes;
  for (const SymmetryAxis& about : points) {
    SymmetryAxis axis{Eigen::Vector2d::Zero(), 0};
    for (const SymmetryAxis& point : points) {
      if ((point.place_m - about.place_m).norm() > together_m) continue;
      axis.place_m += point.score * point.place_m;
      axis.score += point.score;
    }
    axis.place_m /= axis.score;
    axes.push_back(axis);
  }
  std::stable_sort(axes.begin(), axes.end(),
                   [](const SymmetryAxis& a, const SymmetryAxis& b) { return a.score > b.score; });
  std::vector<SymmetryAxis> distinct;
  for (const SymmetryAxis& axis : axes) {
    if (distinct.size() == count) break;
    if (std::none_of(distinct.begin(), distinct.end(), [&](const SymmetryAxis& other) {
          return (other.place_m - axis.place_m).norm() < together_m;
        }))
      distinct.push_back(axis);
  }
  return distinct;
}

}  // namespace alea
