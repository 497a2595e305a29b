#include "alea/report/frames_picture.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/die/corner_frame.hpp"
#include "alea/report/axes.hpp"
#include "alea/report/drawn_die.hpp"
#include "alea/report/scan_image.hpp"
#include "alea/report/view.hpp"

namespace alea {
namespace {

/// One scan's die in the frame that the panel shows.
struct Seen {
  DrawnDie die;
  std::optional<CornerFrame> frame;
  std::vector<Eigen::Vector3d> points;
  std::vector<Rgb> colours;
  RigidTransform shown_from_scan;
};

Seen seen_die(const Cloud& cloud, const ScanSighting& scan, const DieSighting& sighting,
              int up_pips, const RigidTransform& shown_from_scan) {
  Seen seen;
  seen.die = *drawn_die(scan, &sighting);
  seen.frame = corner_frame(sighting.die, up_pips);
  seen.shown_from_scan = shown_from_scan;
  const std::vector<Rgb> grey = intensity_colours(cloud);
  for (const auto& indices : seen.die.read)
    for (const std::uint32_t i : indices) {
      seen.points.push_back(shown_from_scan * cloud.positions[i]);
      seen.colours.push_back(colours::mixed(grey[i], colours::white, 0.45));
    }
  return seen;
}

/// The twelve edges of the parallelepiped, those that the scan sees full, the others light.
void draw_edges(Axes& axes, const ParallelView& view, const Seen& seen, Rgb colour) {
  const auto corners = seen.die.corners_m();
  for (unsigned from = 0; from < 8; ++from)
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned to = from | 1U << k;
      if (to == from) continue;
      const bool hidden = to == 7;
      axes.line(view(seen.shown_from_scan * corners[from]),
                view(seen.shown_from_scan * corners[to]), hidden ? colours::light : colour,
                hidden ? 1 : 2);
    }
}

void draw_axes_of(Axes& axes, const ParallelView& view, const Seen& seen) {
  if (!seen.frame) return;
  const FrameLabel& label = seen.frame->label;
  const auto edge = [](int a, int b) {
    return fmt::format("{}x{}", std::min(a, b), std::max(a, b));
  };
  draw_frame_arrows(axes, view, seen.shown_from_scan * seen.frame->corner_m,
                    seen.shown_from_scan.rotation * seen.frame->axes,
                    0.3 * seen.die.longest_edge_m(),
                    {"X " + edge(label.up, label.x_side), "Y " + edge(label.up, label.y_side),
                     "Z " + edge(label.x_side, label.y_side)},
                    3);
}

std::pair<Eigen::Vector2d, Eigen::Vector2d> bounds_about(const ParallelView& view,
                                                         const std::vector<const Seen*>& dice) {
  std::vector<Eigen::Vector2d> places;
  for (const Seen* seen : dice) {
    for (const Eigen::Vector3d& corner : seen->die.corners_m())
      places.push_back(view(seen->shown_from_scan * corner));
    if (seen->frame)
      places.push_back(
          view(seen->shown_from_scan * (seen->frame->corner_m + 0.7 * seen->die.longest_edge_m() *
                                                                    seen->frame->axes.col(2))));
  }
  return bounds_of(places, 0.12);
}

/// Obliquely from outside the corner, so that its three facets are seen.
ParallelView view_onto(const Seen& seen) {
  Eigen::Vector3d outside = Eigen::Vector3d::Zero();
  for (const Plane& plane : seen.die.corner.planes) outside += plane.normal;
  Eigen::Vector3d from = seen.shown_from_scan.rotation * outside;
  // A little to the side: along the diagonal an edge would hide behind the corner.
  from += 0.35 * seen.shown_from_scan.rotation * seen.die.corner.edges[0];
  return view_from(from);
}

Axes frame_panel(Canvas& canvas, int number, const std::string& title, const ParallelView& view,
                 const std::vector<const Seen*>& dice) {
  const auto bounds = bounds_about(view, dice);
  return Axes(canvas, grid_panel(canvas, 3, 1, number),
              {.title = title,
               .x_name = "right (m)",
               .y_name = "up (m)",
               .low = bounds.first,
               .high = bounds.second,
               .grid = false});
}

void draw_one(Canvas& canvas, int number, const std::string& title, const Seen& seen) {
  const ParallelView view = view_onto(seen);
  Axes axes = frame_panel(canvas, number, title, view, {&seen});
  draw_points(axes, view, seen.points, seen.colours, 1);
  draw_edges(axes, view, seen, colours::ink);
  draw_axes_of(axes, view, seen);
}

void draw_both(Canvas& canvas, const Seen& master, const Seen& slave) {
  // Nearer to the master's view: half way between the two an edge would hide a whole facet.
  const ParallelView view =
      view_from(1.7 * view_onto(master).to_viewer + view_onto(slave).to_viewer);
  Axes axes = frame_panel(canvas, 2, "both, master's frame", view, {&master, &slave});
  for (const auto& [seen, colour] :
       {std::pair(&master, colours::master), std::pair(&slave, colours::slave)}) {
    std::vector<Rgb> tinted(seen->points.size(), colours::mixed(colour, colours::white, 0.6));
    draw_points(axes, view, seen->points, tinted, 1);
  }
  draw_edges(axes, view, master, colours::master);
  draw_edges(axes, view, slave, colours::slave);
  draw_axes_of(axes, view, master);
  draw_axes_of(axes, view, slave);
  axes.legend({{"master", colours::master}, {"slave", colours::slave}});
}

}  // namespace

Picture frames_picture(const StagedDieRegistration& staged) {
  const DieStages& stages = staged.stages;
  if (!stages.pair) throw usage_error("frames_picture: the registration found no pair of dice");
  const DieSighting &in_master = stages.pair->master, &in_slave = stages.pair->slave;
  const int up = upper_pips(in_master.die, in_slave.die);
  const auto of_slave = [&](const RigidTransform& to) {
    const int slave_up = find_facet(in_slave.die, up) != nullptr ? up : in_slave.die.facets[0].pips;
    return seen_die(stages.slave, stages.of_slave, in_slave, slave_up, to);
  };
  Canvas canvas(1560, 540);
  const Seen master = seen_die(stages.master, stages.of_master, in_master, up, {});
  draw_one(canvas, 0, "master", master);
  draw_one(canvas, 1, "slave", of_slave({}));
  const RigidTransform& transform = staged.registration.master_from_slave
                                        ? *staged.registration.master_from_slave
                                        : stages.pair->transform.master_from_slave;
  draw_both(canvas, master, of_slave(transform));
  return canvas.picture();
}

}  // namespace alea
