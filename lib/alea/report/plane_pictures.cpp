#include "alea/report/plane_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "alea/report/axes.hpp"
#include "alea/report/scan_image.hpp"
#include "alea/report/view.hpp"

namespace alea {
namespace {

constexpr std::size_t numbered_planes = 20, mapped_planes = 6;
constexpr double points_per_square = 10;

/// Where the number of each plane goes: the pixel of the plane nearest to the mean of its pixels;
/// empty where none is seen.
std::vector<std::optional<Eigen::Vector2d>> label_places(
    const ScanImage& image, const std::vector<std::size_t>& rank_of_point, std::size_t planes) {
  std::vector<std::vector<Eigen::Vector2d>> pixels(planes);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::int64_t i = image.nearest[static_cast<std::size_t>(y) * image.width + x];
      if (i < 0 || rank_of_point[static_cast<std::size_t>(i)] >= planes) continue;
      pixels[rank_of_point[static_cast<std::size_t>(i)]].emplace_back(
          image.low + image.step * Eigen::Vector2d(x + 0.5, image.height - y - 0.5));
    }
  std::vector<std::optional<Eigen::Vector2d>> places(planes);
  for (std::size_t rank = 0; rank < planes; ++rank) {
    if (pixels[rank].empty()) continue;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& pixel : pixels[rank])
      mean += pixel / static_cast<double>(pixels[rank].size());
    places[rank] = *std::min_element(pixels[rank].begin(), pixels[rank].end(),
                                     [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                                       return (a - mean).squaredNorm() < (b - mean).squaredNorm();
                                     });
  }
  return places;
}

/// Two horizontal or rising unit vectors in the plane: a wall is shown upright.
Eigen::Matrix<double, 2, 3> upright_axes(const Eigen::Vector3d& normal) {
  const ParallelView view = view_from(normal);
  Eigen::Matrix<double, 2, 3> axes;
  axes << view.right.transpose(), view.up.transpose();
  return axes;
}

struct MappedPlane {
  Eigen::Matrix<double, 2, 3> axes;
  Eigen::Vector3d origin;
  Plane plane;
};

/// Mean distance of the points in each square of the map: single points would hide each other.
void draw_map(Canvas& canvas, const PanelArea& area, const std::string& title,
              const MappedPlane& map, const std::vector<Eigen::Vector3d>& points,
              const std::pair<Eigen::Vector2d, Eigen::Vector2d>& bounds, double scale_m) {
  Axes axes(canvas, area,
            {.title = title, .low = bounds.first, .high = bounds.second, .grid = false});
  const double area_m2 = (bounds.second - bounds.first).prod();
  const double cell_m = std::max(
      2 / axes.pixels_per_x(), std::sqrt(area_m2 * points_per_square /
                                         std::max<double>(1, static_cast<double>(points.size()))));
  const Eigen::Array2d cells = ((bounds.second - bounds.first).array() / cell_m).floor() + 1;
  std::vector<Eigen::Vector2d> sums(static_cast<std::size_t>(cells.prod()),
                                    Eigen::Vector2d::Zero());
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Array2d cell =
        ((map.axes * (p - map.origin) - bounds.first) / cell_m).array().floor();
    sums[static_cast<std::size_t>(cell.y() * cells.x() + cell.x())] +=
        Eigen::Vector2d(1, map.plane.signed_distance(p));
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].x() == 0) continue;
    const auto columns = static_cast<std::size_t>(cells.x());
    const Eigen::Vector2d low =
        bounds.first + cell_m * Eigen::Vector2d(static_cast<double>(i % columns),
                                                static_cast<double>(i / columns));
    // The last row and column end with the plane, not beyond the frame.
    const Eigen::Vector2d high = (low + Eigen::Vector2d::Constant(cell_m)).cwiseMin(bounds.second);
    const Eigen::Vector2d upper = axes.at({low.x(), high.y()}),
                          lower = axes.at({high.x(), low.y()});
    canvas.box({std::ceil(upper.x()), std::ceil(upper.y())},
               {std::ceil(lower.x()) - 1, std::ceil(lower.y()) - 1},
               colours::diverging(sums[i].y() / sums[i].x() / scale_m));
  }
}

std::vector<Eigen::Vector3d> points_of(const Cloud& cloud,
                                       const std::vector<std::uint32_t>& indices,
                                       const RigidTransform& to) {
  std::vector<Eigen::Vector3d> points;
  for (const std::uint32_t i : indices) points.push_back(to * cloud.positions[i]);
  return points;
}

double residual_scale_m(std::span<const CheckPlane> checks) {
  double largest = 0.001;
  for (const CheckPlane& check : checks)
    largest = std::max(
        {largest, check.alone_master_m, check.alone_slave_m, 2 * std::abs(check.offset_m)});
  return std::ceil(largest * 1e3) / 1e3;
}

}  // namespace

Picture planes_picture(const Cloud& cloud, const std::vector<PlaneRegion>& planes,
                       const std::string& scan_name,
                       const std::optional<Eigen::Vector3d>& middle_m) {
  std::vector<Rgb> colours = intensity_colours(cloud);
  std::vector<std::size_t> rank_of_point(cloud.size(), planes.size());
  for (std::size_t rank = 0; rank < planes.size(); ++rank)
    for (const std::uint32_t i : planes[rank].indices) {
      colours[i] = colours::mixed(colours[i], colours::categorical(rank), 0.7);
      rank_of_point[i] = rank;
    }
  const ScanImage image = scan_image(cloud, {.middle_m = middle_m});
  // Up to eight pixels of the picture for one of the scan.
  const int width = std::clamp(90 + 8 * image.width, 640, 1560);
  const double aspect = image.width > 0 ? static_cast<double>(image.height) / image.width : 0.5;
  Canvas canvas(width, std::clamp(static_cast<int>((width - 80) * aspect) + 80, 300, 1100));
  Axes axes = draw_scan_image(
      canvas, grid_panel(canvas, 1, 1, 0),
      fmt::format("{}: {} planes, {} points", scan_name, planes.size(), cloud.size()), image,
      colours);
  const std::size_t numbered = std::min(planes.size(), numbered_planes);
  const auto labels = label_places(image, rank_of_point, numbered);
  for (std::size_t rank = 0; rank < numbered; ++rank)
    if (labels[rank])
      axes.text(*labels[rank], std::to_string(rank + 1),
                {.anchor = TextAnchor::centre, .halo = true});
  return canvas.picture();
}

Picture check_plane_maps(const Cloud& master, const Cloud& slave,
                         std::span<const CommonPlane> planes, std::span<const CheckPlane> checks,
                         const RigidTransform& master_from_slave) {
  const std::size_t shown = std::min(planes.size(), mapped_planes);
  const int columns = static_cast<int>(std::max<std::size_t>(shown, 1));
  Canvas sheet(std::max(500, 260 * columns + 90), 560);
  const double scale_m = residual_scale_m(checks);
  const double panel_width = (sheet.width() - 90.0) / columns;
  for (std::size_t i = 0; i < shown; ++i) {
    const PlaneFit& fit = planes[i].fit_master;
    const MappedPlane map{upright_axes(fit.plane.normal), fit.centroid_m, fit.plane};
    const auto of_master = points_of(master, planes[i].indices_master, {});
    const auto of_slave = points_of(slave, planes[i].indices_slave, master_from_slave);
    std::vector<Eigen::Vector2d> places;
    for (const auto* points : {&of_master, &of_slave})
      for (const Eigen::Vector3d& p : *points) places.push_back(map.axes * (p - map.origin));
    const auto bounds = bounds_of(places);
    const double left = panel_width * static_cast<double>(i);
    const char* const role = checks[i].role == CheckPlaneRole::check ? "check" : "calibration";
    draw_map(sheet, {left, 0, panel_width, 275}, fmt::format("{} ({}): master", checks[i].id, role),
             map, of_master, bounds, scale_m);
    draw_map(sheet, {left, 280, panel_width, 275},
             fmt::format("slave: {:+.2f} mm", checks[i].offset_m * 1e3), map, of_slave, bounds,
             scale_m);
  }
  draw_colour_bar(
      sheet, {sheet.width() - 72.0, 60, 14, 420}, colours::diverging, -1, 1,
      {fmt::format("{:.0f} mm", -scale_m * 1e3), "0", fmt::format("{:+.0f} mm", scale_m * 1e3)});
  return sheet.picture();
}

Picture check_plane_chart(std::span<const CheckPlane> checks) {
  double highest = 0.5;
  for (const CheckPlane& check : checks)
    highest = std::max({highest, check.alone_master_m * 1e3, check.alone_slave_m * 1e3,
                        check.union_m * 1e3, std::abs(check.offset_m) * 1e3});
  Canvas canvas(1000, 400);
  const double count = static_cast<double>(checks.size());
  Axes axes(canvas, grid_panel(canvas, 1, 1, 0),
            {.title = "planes that both scans see",
             .x_name = "plane",
             .y_name = "mm",
             .low = {0.4, 0},
             .high = {std::max(count, 1.0) + 0.6, 1.45 * highest},
             .equal_scale = false,
             .whole_x = true});
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const double x = static_cast<double>(i) + 1;
    const CheckPlane& check = checks[i];
    axes.line({x, 0}, {x, std::abs(check.offset_m) * 1e3}, colours::ink, 3);
    axes.point({x - 0.12, check.alone_master_m * 1e3}, colours::master, 5);
    axes.point({x + 0.12, check.alone_slave_m * 1e3}, colours::slave, 5);
    axes.point({x, check.union_m * 1e3}, colours::masked, 5);
  }
  axes.legend({{"RMSE, master alone", colours::master},
               {"RMSE, slave alone", colours::slave},
               {"RMSE, union", colours::masked},
               {"offset, absolute", colours::ink}});
  return canvas.picture();
}

}  // namespace alea
