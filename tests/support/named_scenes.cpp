#include "tests/support/named_scenes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/shuffled_order.hpp"

namespace alea::testing {
namespace {

using Eigen::Vector3d;

// A rectangle ready for rays from one place.
struct Target {
  Vector3d from_scanner, normal, a, b;
  double distance;
};

std::vector<Target> targets_of(const std::vector<Rectangle>& scene, const Vector3d& scanner) {
  std::vector<Target> targets;
  for (const Rectangle& r : scene) {
    const Vector3d normal = r.side_a.cross(r.side_b).normalized();
    const Vector3d corner = r.corner - scanner;
    targets.push_back({corner, normal, r.side_a / r.side_a.squaredNorm(),
                       r.side_b / r.side_b.squaredNorm(), normal.dot(corner)});
  }
  return targets;
}

struct Hit {
  double range = std::numeric_limits<double>::infinity();
  int rectangle = -1;
};

Hit first_hit(const std::vector<Target>& targets, const Vector3d& direction) {
  Hit hit;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const Target& t = targets[k];
    const double range = t.distance / t.normal.dot(direction);
    if (!(range > 1e-6 && range < hit.range)) continue;
    const Vector3d inside = direction * range - t.from_scanner;
    const double s = t.a.dot(inside);
    const double u = t.b.dot(inside);
    if (s < 0 || s > 1 || u < 0 || u > 1) continue;
    hit = {range, static_cast<int>(k)};
  }
  return hit;
}

// Columns (azimuth from -pi) and rows (elevation from -pi/2) of the scanner's angular grid.
struct Raster {
  std::size_t first_column, columns, first_row, rows;
};

Raster raster_of(const ScanOptions& o) {
  const double pi = std::numbers::pi;
  const auto steps = [&](double angle) {
    return static_cast<std::size_t>(std::max(0.0, angle) / o.step_rad);
  };
  if (o.window_radius_m <= 0) return {0, steps(2 * pi), 0, steps(pi)};
  const Vector3d to_window = o.window - o.scanner;
  const double half = std::asin(std::min(1.0, o.window_radius_m / to_window.norm()));
  const double azimuth = std::atan2(to_window.y(), to_window.x());
  const double elevation = std::asin(to_window.z() / to_window.norm());
  const double wide = half / std::cos(elevation);
  return {steps(azimuth - wide + pi), steps(2 * wide), steps(elevation - half + pi / 2),
          steps(2 * half)};
}

// One vertical sweep of the scanner.
struct Sweep {
  std::vector<Vector3d> positions;
  std::vector<int> rectangle;
};

Sweep sweep(const std::vector<Target>& targets, const ScanOptions& o, const RandomStream& noise,
            std::size_t column, const Raster& raster) {
  Sweep out;
  const double azimuth = static_cast<double>(column) * o.step_rad - std::numbers::pi;
  const auto all_rows = static_cast<std::size_t>(std::numbers::pi / o.step_rad);
  for (std::size_t row = raster.first_row; row < raster.first_row + raster.rows; ++row) {
    const double elevation = (static_cast<double>(row) + 0.5) * o.step_rad - std::numbers::pi / 2;
    const Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const Hit hit = first_hit(targets, direction);
    if (hit.rectangle < 0) continue;
    const double range = hit.range + o.range_noise_m * noise.normal_at(column * all_rows + row);
    out.positions.push_back(o.scanner + direction * range);
    out.rectangle.push_back(hit.rectangle);
  }
  return out;
}

}  // namespace

std::vector<Rectangle> box_sides(const Vector3d& base, const Vector3d& size, double turn_rad,
                                 bool with_bottom) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d x = turn.col(0) * size.x();
  const Vector3d y = turn.col(1) * size.y();
  const Vector3d z = Vector3d::UnitZ() * size.z();
  const Vector3d corner = base - x / 2 - y / 2;
  std::vector<Rectangle> sides{
      {corner, x, z}, {corner, y, z}, {corner + x, y, z}, {corner + y, x, z}, {corner + z, x, y}};
  if (with_bottom) sides.push_back({corner, x, y});
  return sides;
}

std::vector<Rectangle> furnished_room() {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  std::vector<Rectangle> room{
      {{0, 0, 0}, 8 * x, 6 * y},           // floor
      {{0, 0, 3}, 8 * x, 6 * y},           // ceiling
      {{0, 0, 0}, 6 * y, 3 * z},           // wall x = 0
      {{0, 6, 0}, 8 * x, 3 * z},           // wall y = 6
      {{0, 0, 0}, 3 * x, 3 * z},           // wall y = 0, left of the door
      {{4, 0, 0}, 4 * x, 3 * z},           // right of the door
      {{3, 0, 2.1}, 1 * x, 0.9 * z},       // above the door
      {{3, -0.12, 0}, 1 * x, 2.1 * z},     // the door, 0.12 m back
      {{3, -0.12, 0}, 0.12 * y, 2.1 * z},  // its jambs
      {{4, -0.12, 0}, 0.12 * y, 2.1 * z},
      {{8, 0, 0}, 2 * y, 3 * z},  // wall x = 8, beside the niche
      {{8, 3.5, 0}, 2.5 * y, 3 * z},
      {{8, 2, 1.5}, 1.5 * y, 1.5 * z},  // above the niche
      {{8.2, 2, 0}, 1.5 * y, 1.5 * z},  // the niche's back, 0.2 m deep
      {{8, 2, 0}, 0.2 * x, 1.5 * z},    // its sides
      {{8, 3.5, 0}, 0.2 * x, 1.5 * z},
      {{6, 4.5, 0}, 1.5 * y, 3 * z},  // partition, 0.15 m thick
      {{6.15, 4.5, 0}, 1.5 * y, 3 * z},
      {{6, 4.5, 0}, 0.15 * x, 3 * z},
  };
  const std::vector<Rectangle> box = box_sides({2, 4, 0}, {0.5, 0.5, 0.5}, std::numbers::pi / 6);
  for (const std::size_t side : {0, 2, 4}) room.push_back(box[side]);
  room.push_back({{5.5, 0.5, 0}, 1.2 * y, 1.5 * x + 0.3 * z});  // ramp
  return room;
}

LabelledScan scan_rectangles(const std::vector<Rectangle>& scene, const ScanOptions& o) {
  const std::vector<Target> targets = targets_of(scene, o.scanner);
  const RandomStream noise(StreamKey{.seed = o.seed, .purpose = Purpose::test});
  const Raster raster = raster_of(o);
  std::vector<Sweep> sweeps(raster.columns);
  parallel_chunks(raster.columns, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      sweeps[c] = sweep(targets, o, noise, raster.first_column + c, raster);
  });
  LabelledScan scan;
  scan.cloud.scanner_position = o.scanner;
  for (const Sweep& s : sweeps) {
    scan.cloud.positions.insert(scan.cloud.positions.end(), s.positions.begin(), s.positions.end());
    scan.rectangle.insert(scan.rectangle.end(), s.rectangle.begin(), s.rectangle.end());
  }
  return scan;
}

LabelledScan cube_scan(double edge_m, double range_m, double drop_m, double step_rad,
                       std::uint64_t seed) {
  ScanOptions options;
  options.step_rad = step_rad;
  options.seed = seed;
  options.scanner = {0, 0, edge_m / 2 + drop_m};
  const Eigen::Vector3d base(range_m, 0.1, 0);
  options.window = base + Eigen::Vector3d(0, 0, edge_m / 2);
  options.window_radius_m = edge_m;
  return scan_rectangles(box_sides(base, Eigen::Vector3d::Constant(edge_m), 0.7), options);
}

Shuffled shuffled(const Cloud& cloud, std::uint64_t seed) {
  const RandomStream stream(StreamKey{.seed = seed, .scan = 1, .purpose = Purpose::test});
  Shuffled out;
  out.origin = experiments::shuffled_order(cloud.size(), stream);
  out.cloud = subset(cloud, out.origin);
  return out;
}

}  // namespace alea::testing
