#include "alea/report/overlay_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "alea/report/axes.hpp"
#include "alea/report/view.hpp"

namespace alea {
namespace {

struct Cut {
  int normal_axis;  // 2: level, 1: upright
  std::string title;
};

/// The points of a scan within the cut, in the two other coordinates of the master's frame.
std::vector<Eigen::Vector2d> cut_points(const Cloud& cloud, const RigidTransform& master_from_scan,
                                        const Cut& cut, const OverlayOptions& options) {
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector3d& scan_point : cloud.positions) {
    const Eigen::Vector3d p = master_from_scan * scan_point;
    if (std::abs(p[cut.normal_axis] - options.about_m[cut.normal_axis]) > options.half_thickness_m)
      continue;
    places.emplace_back(p.x(), cut.normal_axis == 2 ? p.y() : p.z());
  }
  return places;
}

void draw_cut(Canvas& canvas, const PanelArea& area, const Cut& cut,
              const std::pair<Eigen::Vector2d, Eigen::Vector2d>& bounds,
              const std::array<std::vector<Eigen::Vector2d>, 2>& places, double radius_px) {
  Axes axes(canvas, area,
            {.title = cut.title,
             .x_name = "x, master (m)",
             .y_name = cut.normal_axis == 2 ? "y, master (m)" : "z, master (m)",
             .low = bounds.first,
             .high = bounds.second});
  // By turns, so that neither scan hides the other.
  constexpr std::size_t turn = 64;
  const std::size_t most = std::max(places[0].size(), places[1].size());
  for (std::size_t from = 0; from < most; from += turn)
    for (int scan = 0; scan < 2; ++scan)
      for (std::size_t i = from; i < std::min(from + turn, places[scan].size()); ++i)
        axes.point(places[scan][i], scan == 0 ? colours::master : colours::slave, radius_px);
  axes.legend({{"master", colours::master}, {"slave", colours::slave}});
}

}  // namespace

Picture overlay_picture(const Cloud& master, const Cloud& slave,
                        const RigidTransform& master_from_slave, const OverlayOptions& options) {
  Canvas canvas(1400, 1000);
  const std::array<Cut, 2> cuts{{{2, "level cut"}, {1, "upright cut"}}};
  for (int row = 0; row < 2; ++row) {
    const Cut& cut = cuts[row];
    const std::array<std::vector<Eigen::Vector2d>, 2> places{
        cut_points(master, {}, cut, options), cut_points(slave, master_from_slave, cut, options)};
    std::vector<Eigen::Vector2d> all = places[0];
    all.insert(all.end(), places[1].begin(), places[1].end());
    draw_cut(canvas, grid_panel(canvas, 2, 2, 2 * row), cut, bounds_of(all), places, 0.5);
    const Eigen::Vector2d centre(options.about_m.x(),
                                 row == 0 ? options.about_m.y() : options.about_m.z());
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(options.close_radius_m);
    draw_cut(canvas, grid_panel(canvas, 2, 2, 2 * row + 1),
             {cut.normal_axis, cut.title + ", close"}, {centre - half, centre + half}, places, 1);
  }
  return canvas.picture();
}

}  // namespace alea
