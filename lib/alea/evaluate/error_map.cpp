#include "alea/evaluate/error_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace alea {
namespace {

constexpr int most_map_cells = 200;
constexpr double free_field_margin_m = 2;

Eigen::AlignedBox2d extent_of(const Scene& scene) {
  Eigen::AlignedBox2d box;
  for (const Patch& patch : scene.patches)
    for (const Eigen::Vector3d& corner :
         {patch.corner_m, (patch.corner_m + patch.side_u_m).eval(),
          (patch.corner_m + patch.side_v_m).eval(),
          (patch.corner_m + patch.side_u_m + patch.side_v_m).eval()})
      box.extend(corner.head<2>());
  Eigen::AlignedBox2d rest;
  for (const Station& station : scene.stations)
    rest.extend(station.scene_from_scan.translation.head<2>());
  for (const Die& die : scene.dice) rest.extend(bounding_ball(die).centre_m.head<2>());
  for (const Sphere& sphere : scene.spheres) rest.extend(sphere.centre_m.head<2>());
  if (box.isEmpty() || box.sizes().minCoeff() < 1) {
    box.extend(rest.min() - Eigen::Vector2d::Constant(free_field_margin_m));
    box.extend(rest.max() + Eigen::Vector2d::Constant(free_field_margin_m));
  }
  return box;
}

}  // namespace

double point_error_m(const TransformCovariance& covariance, const Eigen::Vector3d& point_m) {
  return std::sqrt(moved_to(covariance, point_m).covariance.bottomRightCorner<3, 3>().trace());
}

int MapArea::columns() const {
  return std::max(1, static_cast<int>(std::ceil((high_m - low_m).x() / cell_m - 1e-9)));
}

int MapArea::rows() const {
  return std::max(1, static_cast<int>(std::ceil((high_m - low_m).y() / cell_m - 1e-9)));
}

Eigen::Vector3d MapArea::at(int column, int row) const {
  return {low_m.x() + (column + 0.5) * cell_m, low_m.y() + (row + 0.5) * cell_m, height_m};
}

MapArea area_of(const Scene& scene, double height_m, double cell_m) {
  const Eigen::AlignedBox2d box = extent_of(scene);
  return {box.min(), box.max(), height_m,
          std::max(cell_m, box.sizes().maxCoeff() / most_map_cells)};
}

double ErrorMap::root_mean_square_m() const {
  double sum = 0;
  for (const double error : error_m) sum += error * error;
  return std::sqrt(sum / static_cast<double>(error_m.size()));
}

double ErrorMap::largest_m() const {
  return *std::max_element(error_m.begin(), error_m.end());
}

double ErrorMap::share_within(double tolerance_m) const {
  const auto count = std::count_if(error_m.begin(), error_m.end(),
                                   [&](double error) { return error <= tolerance_m; });
  return static_cast<double>(count) / static_cast<double>(error_m.size());
}

ErrorMap error_map(const TransformCovariance& covariance, const RigidTransform& master_from_scene,
                   const MapArea& area) {
  ErrorMap map{area, {}};
  map.error_m.reserve(static_cast<std::size_t>(area.columns()) * area.rows());
  for (int row = 0; row < area.rows(); ++row)
    for (int column = 0; column < area.columns(); ++column)
      map.error_m.push_back(point_error_m(covariance, master_from_scene * area.at(column, row)));
  return map;
}

}  // namespace alea
