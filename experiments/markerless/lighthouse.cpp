#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/markerless/twin_parts.hpp"

namespace alea::experiments::markerless {
namespace {

using std::numbers::pi;

Cylinder round(const std::string& id, double z_m, double height_m, double radius_m,
               double top_radius_m) {
  Cylinder cylinder;
  cylinder.id = id;
  cylinder.base_m = {0, 0, z_m};
  cylinder.axis_m = {0, 0, height_m};
  cylinder.radius_m = radius_m;
  cylinder.top_radius_m = top_radius_m;
  cylinder.intensity = 0.85;
  return cylinder;
}

/// Door and windows stand out of the mantle by their frames.
void add_lighthouse(Scene& scene, bool bare) {
  scene.cylinders.push_back(round("tower", -1.5, 12.5, 1.9, 1.4));
  scene.cylinders.push_back(round("gallery", 11, 0.2, 2.0, 2.0));
  scene.cylinders.push_back(round("lantern", 11.2, 1.8, 0.9, 0.9));
  scene.cylinders.push_back(round("cap", 13, 0.7, 1.0, 0.05));
  scene.cylinders.push_back(round("lightning rod", 13.6, 1.8, 0.03, 0.03));
  if (bare) return;
  const auto frame = [&](const char* id, double direction, double z, const Eigen::Vector3d& size) {
    scene.boxes.push_back(upright_box(id, polar(1.55, direction, z), size, direction, 0.5));
  };
  frame("door left", -0.38, -0.2, {0.9, 0.15, 2.3});
  frame("door right", 0.38, -0.2, {0.9, 0.15, 2.3});
  frame("door lintel", 0, 2.1, {1.1, 1.3, 0.2});
  frame("window low", 2.4, 4.2, {0.75, 0.7, 0.9});
  frame("window high", 4.1, 7.6, {0.6, 0.7, 0.9});
}

/// The plane of the slope through the tower's foot, and what is on it.
Eigen::Vector3d on_slope(const Eigen::Vector2d& slope, double x, double y) {
  return {x, y, slope.x() * x + slope.y() * y};
}

void add_ground(Scene& scene, const Eigen::Vector2d& slope, bool bare, RandomStream& stream) {
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
  const Eigen::Vector3d u = Eigen::Vector3d(1, 0, slope.x()).normalized();
  Patch ground;
  ground.id = "slope";
  ground.side_u_m = 80 * u;
  ground.side_v_m = 80 * normal.cross(u);
  ground.corner_m = -(ground.side_u_m + ground.side_v_m) / 2;
  ground.intensity = 0.35;
  scene.patches.push_back(ground);
  for (int mound = 0; mound < (bare ? 0 : 9); ++mound) {
    Sphere ball;
    ball.id = fmt::format("mound {}", mound);
    ball.radius_m = between(stream, 5, 12);
    const double distance = between(stream, 4, 13), direction = between(stream, 0, 2 * pi);
    ball.centre_m =
        on_slope(slope, distance * std::cos(direction), distance * std::sin(direction)) +
        (between(stream, 0.1, 0.5) - ball.radius_m) * normal;
    ball.intensity = 0.35;
    scene.spheres.push_back(ball);
  }
}

void add_surroundings(Scene& scene, const Eigen::Vector2d& slope, RandomStream& stream) {
  const auto foot = [&](double low, double high) {
    const double distance = between(stream, low, high), direction = between(stream, 0, 2 * pi);
    return on_slope(slope, distance * std::cos(direction), distance * std::sin(direction));
  };
  const double shed_heading = between(stream, 0, pi);
  scene.boxes.push_back(upright_box("shed", foot(10, 13) - Eigen::Vector3d(0, 0, 1.5),
                                    {between(stream, 2.5, 4), between(stream, 2, 3), 4.0},
                                    shed_heading, 0.55));
  for (int post = 0; post < 7; ++post) {
    Cylinder cylinder;
    cylinder.id = fmt::format("post {}", post);
    cylinder.base_m = foot(3.5, 11) - Eigen::Vector3d(0, 0, 0.3);
    cylinder.axis_m = {0, 0, between(stream, 1.2, 2.4)};
    cylinder.radius_m = between(stream, 0.06, 0.12);
    cylinder.intensity = 0.5;
    scene.cylinders.push_back(cylinder);
  }
  for (int shrub = 0; shrub < 8; ++shrub) {
    Sphere ball;
    ball.id = fmt::format("shrub {}", shrub);
    ball.centre_m = foot(4.5, 13);
    ball.radius_m = between(stream, 0.3, 1.0);
    ball.intensity = 0.3;
    scene.spheres.push_back(ball);
  }
  for (int tree = 0; tree < 3; ++tree)
    add_tree(scene, fmt::format("tree {}", tree), foot(10, 14), between(stream, 3, 6), stream);
  const double wall_heading = between(stream, 0, pi);
  scene.boxes.push_back(upright_box("wall", foot(7, 10) - Eigen::Vector3d(0, 0, 0.8),
                                    {0.3, between(stream, 3, 6), 1.8}, wall_heading, 0.5));
}

double ground_z(const Scene& scene, const Eigen::Vector2d& slope, double x, double y) {
  double z = on_slope(slope, x, y).z();
  for (const Sphere& ball : scene.spheres) {
    if (!ball.id.starts_with("mound")) continue;
    const double off = (ball.centre_m.head<2>() - Eigen::Vector2d(x, y)).norm();
    if (off < ball.radius_m)
      z = std::max(z, ball.centre_m.z() + std::sqrt(ball.radius_m * ball.radius_m - off * off));
  }
  return z;
}

void add_stations(Scene& scene, const TwinOptions& options, const Eigen::Vector2d& slope,
                  RandomStream& stream) {
  const double turn = between(stream, 0, 2 * pi);
  for (int i = 0; i < 9; ++i) {
    Eigen::Vector3d place;
    for (int attempt = 0; attempt < 200; ++attempt) {
      place = polar(between(stream, 5, 9), turn + 2 * pi / 9 * i + between(stream, -0.25, 0.25), 0);
      if (is_clear(scene, place, 0.4)) break;
    }
    const double tripod = between(stream, 1.5, 1.75), heading = between(stream, -pi / 4, pi / 4);
    place.z() = ground_z(scene, slope, place.x(), place.y()) + tripod;
    scene.stations.push_back(
        levelled_station(fmt::format("ST{}", i + 1), place, heading, options.step_rad, 12));
  }
}

}  // namespace

Scene lighthouse(const TwinOptions& options) {
  RandomStream surroundings({options.layout, 7, 0, 0, Purpose::scene_layout});
  RandomStream stations({options.layout, 7, 0, 0, Purpose::station});
  Scene scene;
  const double fall = options.bare ? 0 : between(surroundings, 0.06, 0.14);
  const double downhill = between(surroundings, 0, 2 * pi);
  const Eigen::Vector2d slope = fall * Eigen::Vector2d(std::cos(downhill), std::sin(downhill));
  add_ground(scene, slope, options.bare, surroundings);
  add_lighthouse(scene, options.bare);
  if (!options.bare) add_surroundings(scene, slope, surroundings);
  add_stations(scene, options, slope, stations);
  return scene;
}

}  // namespace alea::experiments::markerless
