#include "alea/simulate/ray_caster.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/simulate/die_ray.hpp"
#include "alea/simulate/primitive_ray.hpp"
#include "alea/simulate/window.hpp"

namespace alea {
namespace {

struct Cells {
  std::int64_t first;
  std::int64_t last;  ///< included
};

/// The cells of a grid whose angle lies in [low, high].
Cells cells_within(const AngleRange& range, double low_rad, double high_rad) {
  const auto count = static_cast<double>(range.count());
  const double first = std::ceil((low_rad - range.start_rad) / range.step_rad);
  const double last = std::floor((high_rad - range.start_rad) / range.step_rad);
  return {static_cast<std::int64_t>(std::clamp(first, 0.0, count)),
          static_cast<std::int64_t>(std::clamp(last, -1.0, count - 1))};
}

/// Departure of a beam from its nominal direction that is never exceeded (rad).
double margin_rad(const Scanner& scanner) {
  return 8 * scanner.noise.angular_noise_rad + scanner.beam_divergence_rad / 2;
}

bool comes_within(double distance_m, const Eigen::Vector3d& place_m, const Ray& ray) {
  return (place_m - ray.origin).cross(ray.direction).squaredNorm() <= distance_m * distance_m;
}

}  // namespace

template <typename Object>
void RayCaster::add(SurfaceKind kind, const std::vector<Object>& objects, const Station& station) {
  const RigidTransform scan_from_scene = station.scene_from_scan.inverse();
  const Scanner& scanner = station.scanner;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const BoundingBall ball = bounding_ball(objects[i]);
    const AngularWindow window =
        angular_window(scan_from_scene * ball.centre_m, ball.radius_m + scanner.beam_diameter_m / 2,
                       margin_rad(scanner));
    const Cells rows = cells_within(station.elevation, window.low_rad, window.high_rad);
    if (rows.first > rows.last) continue;
    // A grid may cross the cut at +-180 deg: try the window one turn to either side as well.
    const bool all_around = window.half_width_rad >= std::numbers::pi;
    for (int turn = all_around ? 0 : -1; turn <= (all_around ? 0 : 1); ++turn) {
      const double middle = window.azimuth_rad + 2 * std::numbers::pi * turn;
      const double low = middle - window.half_width_rad, high = middle + window.half_width_rad;
      const Cells columns = all_around
                                ? Cells{0, static_cast<std::int64_t>(station.azimuth.count()) - 1}
                                : cells_within(station.azimuth, low, high);
      if (columns.first > columns.last) continue;
      windows_.push_back({{kind, i, columns.first, columns.last}, rows.first, rows.last});
    }
  }
}

RayCaster::RayCaster(const Scene& scene, const Station& station) : scene_(scene) {
  add(SurfaceKind::die, scene.dice, station);
  add(SurfaceKind::patch, scene.patches, station);
  add(SurfaceKind::box, scene.boxes, station);
  add(SurfaceKind::cylinder, scene.cylinders, station);
  add(SurfaceKind::sphere, scene.spheres, station);
  add(SurfaceKind::checkerboard, scene.checkerboards, station);
  add(SurfaceKind::mesh, scene.meshes, station);
  const auto margin_m = [&](const BoundingBall& ball) {
    const double farthest_m =
        (ball.centre_m - station.scene_from_scan.translation).norm() + ball.radius_m;
    return margin_rad(station.scanner) * farthest_m + station.scanner.beam_diameter_m / 2;
  };
  for (const Die& die : scene.dice) die_margin_m_.push_back(margin_m(bounding_ball(die)));
  for (const Sphere& sphere : scene.spheres)
    sphere_reach_m_.push_back(sphere.radius_m + margin_m(bounding_ball(sphere)));
}

std::vector<Candidate> RayCaster::candidates(std::int64_t row) const {
  std::vector<Candidate> found;
  for (const RowWindow& window : windows_)
    if (row >= window.first_row && row <= window.last_row) found.push_back(window.candidate);
  return found;
}

bool RayCaster::may_hit(const std::vector<Candidate>& candidates, std::int64_t column,
                        const Ray& nominal) const {
  for (const Candidate& c : candidates) {
    if (column < c.first_column || column > c.last_column) continue;
    if (c.kind == SurfaceKind::die
            ? passes(scene_.dice[c.index], die_margin_m_[c.index], nominal)
            : c.kind != SurfaceKind::sphere ||
                  comes_within(sphere_reach_m_[c.index], scene_.spheres[c.index].centre_m, nominal))
      return true;
  }
  return false;
}

Hit RayCaster::cast(const std::vector<Candidate>& candidates, std::int64_t column,
                    const Ray& ray) const {
  Hit hit;
  for (const Candidate& c : candidates) {
    if (column < c.first_column || column > c.last_column) continue;
    switch (c.kind) {
      case SurfaceKind::die:
        intersect(scene_.dice[c.index], c.index, ray, hit);
        break;
      case SurfaceKind::patch:
        intersect(scene_.patches[c.index], c.index, ray, hit);
        break;
      case SurfaceKind::box:
        intersect(scene_.boxes[c.index], c.index, ray, hit);
        break;
      case SurfaceKind::cylinder:
        intersect(scene_.cylinders[c.index], c.index, ray, hit);
        break;
      case SurfaceKind::sphere:
        intersect(scene_.spheres[c.index], c.index, ray, hit);
        break;
      case SurfaceKind::checkerboard:
        intersect(scene_.checkerboards[c.index], c.index, ray, hit);
        break;
      case SurfaceKind::mesh:
        intersect(scene_.meshes[c.index], c.index, ray, hit);
        break;
    }
  }
  return hit;
}

}  // namespace alea
