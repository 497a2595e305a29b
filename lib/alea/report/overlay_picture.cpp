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
              const std::array<std::vector<Eigen::Vector2d>, 2>& places, double radius_px,
              const OverlayOptions& options) {
  const std::string frame = ", " + options.master_name + " (m)";
  Axes axes(canvas, area,
            {.title = cut.title,
             .x_name = "x" + frame,
             .y_name = (cut.normal_axis == 2 ? "y" : "z") + frame,
             .low = bounds.first,
             .high = bounds.second});
  // By turns, so that neither scan hides the other.
  constexpr std::size_t turn = 64;
  const std::size_t most = std::max(places[0].size(), places[1].size());
  for (std::size_t from = 0; from < most; from += turn)
    for (int scan = 0; scan < 2; ++scan)
      for (std::size_t i = from; i < std::min(from + turn, places[scan].size()); ++i)
        axes.point(places[scan][i], scan == 0 ? colours::master : colours::slave, radius_px);
  axes.legend({{options.master_name, colours::master}, {options.slave_name, colours::slave}});
}

const std::array<Cut, 2> cuts{{{2, "level cut"}, {1, "upright cut"}}};

std::pair<Eigen::Vector2d, Eigen::Vector2d> close_bounds(const Cut& cut,
                                                         const OverlayOptions& options) {
  const Eigen::Vector2d centre(options.about_m.x(),
                               cut.normal_axis == 2 ? options.about_m.y() : options.about_m.z());
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(options.close_radius_m);
  return {centre - half, centre + half};
}

}  // namespace

Picture overlay_picture(const Cloud& master, const Cloud& slave,
                        const RigidTransform& master_from_slave, const OverlayOptions& options) {
  Canvas canvas(1400, 1000);
  for (int row = 0; row < 2; ++row) {
    const Cut& cut = cuts[row];
    const std::array<std::vector<Eigen::Vector2d>, 2> places{
        cut_points(master, {}, cut, options), cut_points(slave, master_from_slave, cut, options)};
    std::vector<Eigen::Vector2d> all = places[0];
    all.insert(all.end(), places[1].begin(), places[1].end());
    draw_cut(canvas, grid_panel(canvas, 2, 2, 2 * row), cut, bounds_of(all), places, 0.5, options);
    draw_cut(canvas, grid_panel(canvas, 2, 2, 2 * row + 1),
             {cut.normal_axis, cut.title + ", close"}, close_bounds(cut, options), places, 1,
             options);
  }
  return canvas.picture();
}

Picture overlay_comparison(const Cloud& master, const Cloud& slave,
                           const std::array<NamedPose, 2>& poses, const OverlayOptions& options) {
  Canvas canvas(1400, 1400);
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column) {
      const NamedPose& pose = poses[column];
      const Cut cut{cuts[row].normal_axis, pose.name + ": " + cuts[row].title};
      draw_cut(canvas, grid_panel(canvas, 2, 2, 2 * row + column), cut, close_bounds(cut, options),
               {cut_points(master, {}, cut, options),
                cut_points(slave, pose.master_from_slave, cut, options)},
               1, options);
    }
  return canvas.picture();
}

}  // namespace alea
