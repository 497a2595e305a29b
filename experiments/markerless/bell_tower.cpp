#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/markerless/twin_parts.hpp"

namespace alea::experiments::markerless {
namespace {

using std::numbers::pi;
constexpr double side_m = 3, wall_m = 0.3, storey_m = 6, floor_m = 0.3;
const double apothem_m = side_m * std::cos(pi / 6);

double direction_of(int side) {
  return pi / 3 * side + pi / 6;
}

/// A hexagonal slab: the union of the three rectangles on opposite sides.
void add_slab(Scene& scene, const std::string& id, double side, double z_m, double thickness_m) {
  for (int k = 0; k < 3; ++k)
    scene.boxes.push_back(upright_box(fmt::format("{} {}", id, k), {0, 0, z_m},
                                      {2 * side * std::cos(pi / 6), side, thickness_m},
                                      direction_of(k), 0.55));
}

/// One wall with an opening of `width_m` from `low_m` to `high_m`: four boxes around it.
void add_wall(Scene& scene, int side, double width_m, double low_m, double high_m) {
  const double direction = direction_of(side), middle = apothem_m - wall_m / 2;
  const Eigen::Vector3d along(-std::sin(direction), std::cos(direction), 0);
  const auto add = [&](const char* part, double from, double to, double low, double high) {
    if (high <= low) return;
    const Eigen::Vector3d base = polar(middle, direction, low) + (from + to) / 2 * along;
    scene.boxes.push_back(upright_box(fmt::format("wall {} {}", side, part), base,
                                      {wall_m, to - from, high - low}, direction, 0.7));
  };
  add("left", -side_m / 2, -width_m / 2, 0, storey_m);
  add("right", width_m / 2, side_m / 2, 0, storey_m);
  add("sill", -width_m / 2, width_m / 2, 0, low_m);
  add("lintel", -width_m / 2, width_m / 2, high_m, storey_m);
}

void add_bell_tower(Scene& scene, bool bare) {
  for (int side = 0; side < 6; ++side) {
    if (side == 0 && !bare)
      add_wall(scene, side, 1.1, 0, 2.5);
    else
      add_wall(scene, side, 0.9, 1.3, 3.1);
  }
  add_slab(scene, "floor", side_m - 0.2, 0, floor_m);
  add_slab(scene, "roof", side_m + 0.25, storey_m, 0.25);
  for (int corner = 0; corner < 6; ++corner)
    scene.boxes.push_back(upright_box(fmt::format("belfry post {}", corner),
                                      polar(side_m - 0.6, pi / 3 * corner, storey_m),
                                      {0.35, 0.35, 2.2}, pi / 3 * corner, 0.6));
  add_slab(scene, "belfry roof", side_m - 0.2, storey_m + 2.2, 0.2);
  Sphere bell;
  bell.id = "bell";
  bell.centre_m = {0, 0, storey_m + 1.3};
  bell.radius_m = 0.5;
  bell.intensity = 0.2;
  scene.spheres.push_back(bell);
}

void add_indoor_clutter(Scene& scene, RandomStream& stream) {
  // The bell rope's beam, a stair along one wall and some furniture.
  scene.boxes.push_back(
      upright_box("beam", {0.4, 0, 4.6}, {0.25, 2 * apothem_m - 0.7, 0.3}, 0, 0.4));
  const int side = 2 + static_cast<int>(stream.below(3));
  const double direction = direction_of(side);
  const Eigen::Vector3d along(-std::sin(direction), std::cos(direction), 0);
  for (int step = 0; step < 5; ++step)
    scene.boxes.push_back(upright_box(fmt::format("stair {}", step),
                                      polar(1.95, direction, floor_m) + (0.28 * step - 0.6) * along,
                                      {0.6, 0.28, 0.22 * (step + 1)}, direction, 0.5));
  const double table = direction_of(side == 4 ? 1 : 5);
  scene.boxes.push_back(upright_box("table",
                                    polar(1.9, table + between(stream, -0.2, 0.2), floor_m),
                                    {0.6, between(stream, 0.7, 1.1), 0.75}, table, 0.5));
  scene.boxes.push_back(upright_box(
      "chest", polar(1.75, between(stream, -0.3, 0.3) + direction_of(1), floor_m),
      {0.45, 0.6, between(stream, 0.4, 1.2)}, direction_of(1) + between(stream, -0.3, 0.3), 0.45));
}

void add_doorstep(Scene& scene) {
  const double direction = direction_of(0);
  for (int step = 0; step < 2; ++step)
    scene.boxes.push_back(upright_box(
        fmt::format("step {}", step), polar(apothem_m + 0.2 + 0.3 * (1 - step), direction, 0),
        {0.4 + 0.6 * (1 - step), 1.8, 0.15 * (step + 1)}, direction, 0.6));
}

void add_surroundings(Scene& scene, RandomStream& stream) {
  add_doorstep(scene);
  for (int house = 0; house < 2; ++house) {
    const double direction = between(stream, 0, 2 * pi);
    scene.boxes.push_back(
        upright_box(fmt::format("house {}", house), polar(between(stream, 14, 18), direction, 0),
                    {between(stream, 4, 7), between(stream, 5, 9), between(stream, 3, 5)},
                    direction + between(stream, -0.6, 0.6), 0.6));
  }
  const double garden = between(stream, 0, 2 * pi);
  scene.boxes.push_back(upright_box("garden wall", polar(between(stream, 9, 11), garden, 0),
                                    {0.25, between(stream, 5, 9), between(stream, 0.8, 1.3)},
                                    garden + between(stream, -0.5, 0.5), 0.5));
  const double bench = between(stream, 0, 2 * pi);
  scene.boxes.push_back(upright_box("bench", polar(between(stream, 3.9, 4.6), bench, 0),
                                    {0.45, 1.6, 0.45}, bench + between(stream, -0.4, 0.4), 0.4));
  const double car = between(stream, 0, 2 * pi);
  scene.boxes.push_back(upright_box("car", polar(between(stream, 8, 10), car, 0), {4.2, 1.8, 1.45},
                                    between(stream, 0, pi), 0.3));
  const int trees = 4 + static_cast<int>(stream.below(4));
  for (int tree = 0; tree < trees; ++tree)
    add_tree(scene, fmt::format("tree {}", tree),
             polar(between(stream, 7.5, 13), between(stream, 0, 2 * pi), 0),
             between(stream, 3.5, 6.5), stream);
  for (int mound = 0; mound < 5; ++mound) {  // uneven ground: caps of large balls
    Sphere ball;
    ball.id = fmt::format("mound {}", mound);
    ball.radius_m = between(stream, 8, 16);
    const double rise = between(stream, 0.08, 0.3);
    ball.centre_m = polar(between(stream, 7, 15), between(stream, 0, 2 * pi), rise - ball.radius_m);
    ball.intensity = 0.4;
    scene.spheres.push_back(ball);
  }
}

void add_ground(Scene& scene) {
  Patch ground;
  ground.id = "ground";
  ground.corner_m = {-60, -60, 0};
  ground.side_u_m = {120, 0, 0};
  ground.side_v_m = {0, 120, 0};
  ground.intensity = 0.4;
  scene.patches.push_back(ground);
}

/// The first clear place of up to 200 draws near a ring; indoors the ring is about the axis.
Eigen::Vector3d clear_place(const Scene& scene, RandomStream& stream, double low_m, double high_m,
                            double direction_rad, double spread_rad, double z_m) {
  Eigen::Vector3d place;
  for (int i = 0; i < 200; ++i) {
    place = polar(between(stream, low_m, high_m),
                  direction_rad + between(stream, -spread_rad, spread_rad), z_m);
    Scene without_slabs = scene;
    std::erase_if(without_slabs.boxes, [](const Box& box) {
      return box.id.starts_with("floor") || box.id.starts_with("roof") ||
             box.id.starts_with("belfry") || box.id == "beam";
    });
    std::erase_if(without_slabs.spheres, [](const Sphere& ball) { return ball.id == "bell"; });
    if (is_clear(without_slabs, place, 0.35)) break;
  }
  return place;
}

void add_stations(Scene& scene, const TwinOptions& options, RandomStream& stream) {
  const double turn = between(stream, 0, 2 * pi);
  for (int i = 0; i < 10; ++i) {
    const bool outdoors = i < 5;
    const double direction = turn + 2 * pi / 5 * i;
    const Eigen::Vector3d place =
        outdoors ? clear_place(scene, stream, 5.4, 6.8, direction, 0.25, 0)
                 : clear_place(scene, stream, 0.3, 1.3, direction, 0.5, floor_m);
    const double tripod = between(stream, 1.5, 1.75), heading = between(stream, -pi / 4, pi / 4);
    scene.stations.push_back(levelled_station(fmt::format("ST{}", i + 1),
                                              place + Eigen::Vector3d(0, 0, tripod), heading,
                                              options.step_rad, 15));
  }
}

}  // namespace

Scene bell_tower(const TwinOptions& options) {
  RandomStream surroundings({options.layout, 6, 0, 0, Purpose::scene_layout});
  RandomStream stations({options.layout, 6, 0, 0, Purpose::station});
  Scene scene;
  add_ground(scene);
  add_bell_tower(scene, options.bare);
  if (!options.bare) {
    add_indoor_clutter(scene, surroundings);
    add_surroundings(scene, surroundings);
  }
  add_stations(scene, options, stations);
  return scene;
}

}  // namespace alea::experiments::markerless
