#include <fmt/format.h>

#include <filesystem>
#include <iterator>

#include "alea/core/angle.hpp"
#include "alea/die/paper_registration.hpp"
#include "alea/io/atomic_file.hpp"
#include "experiments/die/figures.hpp"
#include "experiments/die/skewed_die.hpp"

namespace alea::experiments::die {
namespace {

// One arrow: panel, what it is, its letter, from, to.
void append_arrow(std::string& csv, const std::string& panel, const std::string& kind,
                  const std::string& letter, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  fmt::format_to(std::back_inserter(csv), "{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f}\n",
                 panel, kind, letter, from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
}

const std::string header = "panel,kind,letter,x0_m,y0_m,z0_m,x1_m,y1_m,z1_m\n";
const char* const letters[] = {"X", "Y", "Z"};

void append_axes(std::string& csv, const std::string& panel, const std::string& kind,
                 const Eigen::Vector3d& corner_m, const Eigen::Matrix3d& axes, double length_m,
                 const RigidTransform& shown_from_scan) {
  for (int k = 0; k < 3; ++k)
    append_arrow(csv, panel, kind, letters[k], shown_from_scan * corner_m,
                 shown_from_scan * Eigen::Vector3d(corner_m + length_m * axes.col(k)));
}

void append_cube(std::string& csv, const std::string& panel, double edge_m,
                 const RigidTransform& shown_from_die) {
  for (int a = 0; a < 8; ++a)
    for (int bit = 0; bit < 3; ++bit) {
      const int b = a | (1 << bit);
      if (b == a) continue;
      const auto corner = [&](int c) {
        return shown_from_die * Eigen::Vector3d(edge_m * ((c & 1) - 0.5),
                                                edge_m * (((c >> 1) & 1) - 0.5),
                                                edge_m * (((c >> 2) & 1) - 0.5));
      };
      append_arrow(csv, panel, "edge", "", corner(a), corner(b));
    }
}

PaperRegistration register_tilted(const SkewedDie& die) {
  PaperRegistrationOptions options;
  options.dimensions = {0.5, 0.5, 0.5, 0};
  options.up_pips = 1;
  return *register_paper(die.master, die.slave, options);
}

// Tilts of 5 deg sd, so that the eye sees what equations 1 to 3 do.
std::string axes_csv(double tilt_sd_deg) {
  SkewedDieOptions geometry;
  geometry.tilt_sd_rad = tilt_sd_deg * deg;
  const SkewedDie die = draw_skewed_die(geometry, 3, 0);
  const PaperRegistration result = register_tilted(die);
  std::string csv = header;
  const RigidTransform here{};
  append_axes(csv, "a", "V before", result.master_frame.corner_m, result.master_frame.axes, 0.5,
              here);
  append_axes(csv, "a", "U before", result.slave_frame.corner_m, result.slave_frame.axes, 0.5,
              die.master_from_slave);
  append_axes(csv, "b", "V after", result.v.corner_m, result.v.axes, 0.5, here);
  append_axes(csv, "b", "U after", result.u.corner_m, result.u.axes, 0.5, die.master_from_slave);
  return csv;
}

std::string all_frames_csv() {
  std::string csv = header;
  int number = 0;
  for (const FrameLabel& label : all_frame_labels(Chirality::clockwise)) {
    const DieShape shape = cube(1, Chirality::clockwise);
    const std::string panel = fmt::format("{}: {} up; {}", ++number, label.up, axis_names(label));
    append_cube(csv, panel, 1, {});
    const Eigen::Vector3d up = shape.facet(label.up)->normal, x = shape.facet(label.x_side)->normal,
                          y = shape.facet(label.y_side)->normal;
    const Eigen::Vector3d corner = 0.5 * (up + x + y);
    // X runs into the die along the edge of the upper facet with x_side: against y_side's normal.
    Eigen::Matrix3d axes;
    axes << -y, -x, up;
    append_axes(csv, panel, "frame", corner, axes, 0.6, {});
  }
  return csv;
}

// Figure 9: both frames and both stations, in the master's system, after the registration.
std::string registered_csv() {
  SkewedDieOptions geometry;
  geometry.distance_m = {1.2, 1.5};
  geometry.separation_rad = 180 * deg;
  const SkewedDie die = draw_skewed_die(geometry, 1, 0);
  const PaperRegistration result = register_tilted(die);
  std::string csv = header;
  append_axes(csv, "registered", "V", result.v.corner_m, result.v.axes, 0.35, {});
  append_axes(csv, "registered", "U", result.u.corner_m, result.u.axes, 0.35,
              result.master_from_slave);
  append_axes(csv, "registered", "Station 1", {0, 0, 0}, Eigen::Matrix3d::Identity(), 0.35, {});
  append_axes(csv, "registered", "Station 2", {0, 0, 0}, Eigen::Matrix3d::Identity(), 0.35,
              result.master_from_slave);
  RigidTransform upright{result.v.axes, die.centre_in_master_m};
  append_cube(csv, "registered", 0.5, upright);
  return csv;
}

}  // namespace

void write_frame_figures(const std::string& folder) {
  const std::filesystem::path path(folder);
  write_file_atomically(path / "figure7.csv", axes_csv(5));
  write_file_atomically(path / "figure8.csv", all_frames_csv());
  write_file_atomically(path / "figure9.csv", registered_csv());
}

}  // namespace alea::experiments::die
