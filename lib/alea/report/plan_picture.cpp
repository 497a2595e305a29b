#include "alea/report/plan_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "alea/report/axes.hpp"
#include "alea/report/contours.hpp"

namespace alea {
namespace {

constexpr int panel_width_px = 860, height_px = 720, bar_width_px = 90;
constexpr Rgb tolerance_colour{196, 30, 58};

/// Yellow (small) over green to dark violet (large).
Rgb error_colour(double share) {
  constexpr std::array<Rgb, 5> anchors{
      {{250, 235, 120}, {120, 205, 110}, {40, 150, 140}, {58, 84, 140}, {60, 10, 90}}};
  const double at = std::clamp(share, 0.0, 1.0) * (anchors.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
  return colours::mixed(anchors[first], anchors[first + 1], at - static_cast<double>(first));
}

/// Millimetres with the digits that they deserve.
std::string millimetres(double metres) {
  const double mm = metres * 1e3;
  return mm < 1 ? fmt::format("{:.2f}", mm) : fmt::format("{:.3g}", mm);
}

struct Scale {
  double low_m, high_m;
  Rgb operator()(double error_m) const {
    return error_colour((error_m - low_m) / (high_m - low_m));
  }
};

Scale scale_of(const PlanDrawing& drawing) {
  double high = drawing.map.largest_m();
  if (drawing.achieved) high = std::max(high, drawing.achieved->largest_m());
  return {0, std::max(high, 1e-9)};
}

void draw_cells(Axes& axes, const ErrorMap& map, const Scale& scale) {
  const double half = map.area.cell_m / 2;
  for (int row = 0; row < map.area.rows(); ++row)
    for (int column = 0; column < map.area.columns(); ++column) {
      const Eigen::Vector2d at = map.area.at(column, row).head<2>();
      const Eigen::Vector2d a = axes.at(at - Eigen::Vector2d::Constant(half));
      const Eigen::Vector2d b = axes.at(at + Eigen::Vector2d::Constant(half));
      axes.canvas().box(a.cwiseMin(b), a.cwiseMax(b), scale(map.at(column, row)));
    }
}

void draw_contour(Axes& axes, const ErrorMap& map, double level_m, Rgb colour, int width_px) {
  const auto place = [&](const Eigen::Vector2d& node) -> Eigen::Vector2d {
    return map.area.low_m + (node + Eigen::Vector2d::Constant(0.5)) * map.area.cell_m;
  };
  const auto pieces = contour_pieces(map.error_m, map.area.columns(), map.area.rows(), level_m);
  for (const ContourPiece& piece : pieces)
    axes.line(place(piece.first), place(piece.second), colour, width_px);
  if (pieces.empty()) return;
  // Named where the line is rightmost, inside the map.
  const auto rightmost = std::max_element(
      pieces.begin(), pieces.end(),
      [](const ContourPiece& a, const ContourPiece& b) { return a.first.x() < b.first.x(); });
  axes.text(place(rightmost->first), millimetres(level_m),
            {.height_px = 9, .anchor = TextAnchor::right, .halo = true});
}

void draw_polygon(Axes& axes, const std::vector<Eigen::Vector2d>& corners, Rgb colour,
                  int width_px) {
  for (std::size_t k = 0; k < corners.size(); ++k)
    axes.line(corners[k], corners[(k + 1) % corners.size()], colour, width_px);
}

void draw_circle(Axes& axes, const Eigen::Vector2d& centre, double radius_m, Rgb colour) {
  axes.canvas().circle(axes.at(centre), radius_m * axes.pixels_per_x(), colour, 2);
}

void draw_furniture(Axes& axes, const Scene& scene) {
  for (const Patch& patch : scene.patches) {
    if (std::abs(plane_of(patch).normal.z()) > 0.9) continue;
    const Eigen::Vector3d far = patch.corner_m + patch.side_u_m + patch.side_v_m;
    axes.line(patch.corner_m.head<2>(), far.head<2>(), colours::ink, 3);
  }
  for (const Box& box : scene.boxes) {
    std::vector<Eigen::Vector2d> corners;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      corners.push_back(
          (box.scene_from_box * Eigen::Vector3d(x * box.size_m.x() / 2, y * box.size_m.y() / 2, 0))
              .head<2>());
    draw_polygon(axes, corners, colours::ink, 2);
  }
  for (const Cylinder& cylinder : scene.cylinders)
    draw_circle(axes, cylinder.base_m.head<2>(), cylinder.radius_m, colours::ink);
  for (const Sphere& sphere : scene.spheres)
    draw_circle(axes, sphere.centre_m.head<2>(), sphere.radius_m, colours::ink);
}

/// The rectangle that the die's two most level axes span.
void draw_die_outline(Axes& axes, const Die& die) {
  const Eigen::Matrix3d sides = die.model.scene_from_die.rotation * die.model.size_m.asDiagonal();
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(sides.col(a).normalized().z()) < std::abs(sides.col(b).normalized().z());
  });
  const Eigen::Vector3d centre = bounding_ball(die).centre_m;
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [s, t] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    corners.push_back((centre + s * sides.col(order[0]) + t * sides.col(order[1])).head<2>());
  draw_polygon(axes, corners, colours::black, 3);
  axes.text(centre.head<2>(), "die", {.height_px = 9, .anchor = TextAnchor::centre, .halo = true});
}

void draw_station(Axes& axes, const Station& station, Rgb colour) {
  const Eigen::Vector2d at = station.scene_from_scan.translation.head<2>();
  axes.point(at, colours::white, 8);
  axes.point(at, colour, 6);
  axes.canvas().text(
      axes.at(at) + Eigen::Vector2d(0, 17), station.name,
      {.height_px = 10, .colour = colour, .anchor = TextAnchor::centre, .halo = true});
}

void draw_checks(Axes& axes, const PlanDrawing& drawing, const Scale& scale) {
  for (const PlanCheck& check : drawing.checks) {
    const Eigen::Vector2d at = check.centroid_m.head<2>();
    axes.point(at, colours::white, 12);
    axes.point(at, scale(std::abs(check.offset_m)), 10);
    axes.canvas().text(
        axes.at(at) + Eigen::Vector2d(0, -20),
        fmt::format("{}: {} (sd {})", check.id, millimetres(std::abs(check.offset_m)),
                    millimetres(check.predicted_sd_m)),
        {.height_px = 10, .anchor = TextAnchor::centre, .halo = true});
  }
}

void draw_panel(Canvas& canvas, const Scene& scene, const PlanDrawing& drawing, int number,
                const ErrorMap& map, const std::string& title, const Scale& scale) {
  AxesOptions options;
  options.title = title;
  options.x_name = "x (m)";
  options.y_name = "y (m)";
  options.low = map.area.low_m;
  options.high =
      map.area.low_m + map.area.cell_m * Eigen::Vector2d(map.area.columns(), map.area.rows());
  options.grid = false;
  Axes axes(canvas,
            {static_cast<double>(number * panel_width_px), 6.0, static_cast<double>(panel_width_px),
             static_cast<double>(height_px - 12)},
            options);
  draw_cells(axes, map, scale);
  for (const double level_m : round_ticks(scale.low_m, scale.high_m, 8))
    if (level_m > 0) draw_contour(axes, map, level_m, colours::white, 1);
  draw_contour(axes, map, drawing.tolerance_m, tolerance_colour, 3);
  draw_furniture(axes, scene);
  for (const Die& die : scene.dice) draw_die_outline(axes, die);
  draw_station(axes, scene.stations.front(), colours::master);
  draw_station(axes, scene.stations.at(drawing.slave), colours::slave);
  if (number == 0 && drawing.best_die) {
    const Eigen::Vector2d at = drawing.best_die->head<2>();
    axes.canvas().circle(axes.at(at), 11, tolerance_colour, 3);
    axes.canvas().text(
        axes.at(at) + Eigen::Vector2d(0, -20), "best place",
        {.height_px = 10, .colour = tolerance_colour, .anchor = TextAnchor::centre, .halo = true});
  }
  if (number == 1) draw_checks(axes, drawing, scale);
}

}  // namespace

Picture draw_plan(const Scene& scene, const PlanDrawing& drawing) {
  const bool measured = drawing.achieved || !drawing.checks.empty();
  const int panels = measured ? 2 : 1;
  Canvas canvas(panels * panel_width_px + bar_width_px, height_px);
  const Scale scale = scale_of(drawing);
  const std::string at = fmt::format("at z = {:g} m", drawing.map.area.height_m);
  draw_panel(canvas, scene, drawing, 0, drawing.map,
             fmt::format("Predicted RMS error (mm) {}; bold: tolerance {} mm", at,
                         millimetres(drawing.tolerance_m)),
             scale);
  if (measured)
    draw_panel(canvas, scene, drawing, 1, drawing.achieved.value_or(drawing.map),
               fmt::format("By the registration's covariance {}; check planes: |offset| (mm)", at),
               scale);
  draw_colour_bar(
      canvas, {panels * panel_width_px + 4.0, 40.0, 20.0, static_cast<double>(height_px - 90)},
      error_colour, 0, 1,
      {"0 mm", millimetres(scale.high_m / 2) + " mm", millimetres(scale.high_m) + " mm"});
  return canvas.picture();
}

}  // namespace alea
