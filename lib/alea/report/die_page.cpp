#include "alea/report/die_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "alea/core/angle.hpp"
#include "alea/report/die_pictures.hpp"
#include "alea/report/frames_picture.hpp"
#include "alea/report/overlay_picture.hpp"
#include "alea/report/plane_pictures.hpp"

namespace alea {
namespace {

PageTable transform_table(const Registration& registration) {
  const RigidTransform& t = *registration.master_from_slave;
  PageTable table{.title = "Transform: p_master = R p_slave + t",
                  .columns = {"", "x", "y", "z", "t (m)"}};
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> row{fmt::format("row {}", i + 1)};
    for (int j = 0; j < 3; ++j) row.push_back(fmt::format("{:.9f}", t.rotation(i, j)));
    row.push_back(fmt::format("{:.6f}", t.translation[i]));
    table.rows.push_back(row);
  }
  const Eigen::Vector3d angles = omega_phi_kappa_rad(t.rotation) * deg_per_rad;
  table.note = fmt::format(
      "Omega, phi, kappa (R = Rz(kappa) Ry(phi) Rx(omega)): {:.5f}, {:.5f}, {:.5f} deg.",
      angles.x(), angles.y(), angles.z());
  if (!registration.covariance) {
    table.note += " No covariance: the published method has none.";
    return table;
  }
  const Vector6d sd = registration.covariance->covariance.diagonal().cwiseSqrt();
  const Eigen::Vector3d& about = registration.covariance->about_m;
  table.note += fmt::format(
      " Standard deviation: rotation {:.5f}, {:.5f}, {:.5f} deg, translation {:.3f}, {:.3f}, "
      "{:.3f} "
      "mm about ({:.3f}, {:.3f}, {:.3f}) m, left perturbation in the master's frame.",
      sd[0] * deg_per_rad, sd[1] * deg_per_rad, sd[2] * deg_per_rad, sd[3] * 1e3, sd[4] * 1e3,
      sd[5] * 1e3, about.x(), about.y(), about.z());
  return table;
}

PageTable facet_table(const DieReport& die) {
  PageTable table{.title = "Facets",
                  .columns = {"scan", "pips", "points", "RMSE along the normal (mm)",
                              "probability of the pips", "variance factor"}};
  for (const FacetReport& facet : die.facets)
    table.rows.push_back({facet.in_master ? "master" : "slave", std::to_string(facet.pips),
                          std::to_string(facet.points), fmt::format("{:.3f}", facet.rmse_m * 1e3),
                          fmt::format("{:.5f}", facet.pip_probability),
                          fmt::format("{:.2f}", facet.variance_factor)});
  if (die.shared_edge && die.edge_m)
    table.note = fmt::format("Shared edge {}: {:.5f} m{}.", *die.shared_edge, *die.edge_m,
                             die.calibrated ? ", calibrated" : "");
  return table;
}

PageTable angle_table(const DieReport& die) {
  PageTable table{.title = "Angles inside the die",
                  .columns = {"facets", "master (deg)", "slave (deg)"}};
  std::map<std::string, std::array<std::string, 2>> rows;
  for (const auto& [name, angle] : die.angles_master_rad)
    rows[name][0] = fmt::format("{:.4f}", angle * deg_per_rad);
  for (const auto& [name, angle] : die.angles_slave_rad)
    rows[name][1] = fmt::format("{:.4f}", angle * deg_per_rad);
  for (const auto& [name, cells] : rows) table.rows.push_back({name, cells[0], cells[1]});
  return table;
}

PageTable plane_table(const std::vector<CheckPlane>& planes) {
  PageTable table{.title = "Planes that both scans see",
                  .columns = {"plane", "role", "points, master", "points, slave",
                              "alone, master (mm)", "alone, slave (mm)", "union (mm)",
                              "slave to master (mm)", "offset (mm)", "tilt (deg)"},
                  .note =
                      "RMSE of orthogonal fits; offset: slave minus master along the master's "
                      "normal. A union RMSE hides an offset of the size of the noise."};
  for (const CheckPlane& plane : planes)
    table.rows.push_back({std::to_string(plane.id),
                          plane.role == CheckPlaneRole::check ? "check" : "calibration",
                          std::to_string(plane.points_master), std::to_string(plane.points_slave),
                          fmt::format("{:.3f}", plane.alone_master_m * 1e3),
                          fmt::format("{:.3f}", plane.alone_slave_m * 1e3),
                          fmt::format("{:.3f}", plane.union_m * 1e3),
                          fmt::format("{:.3f}", plane.slave_to_master_m * 1e3),
                          fmt::format("{:+.3f}", plane.offset_m * 1e3),
                          fmt::format("{:.4f}", plane.tilt_rad * deg_per_rad)});
  return table;
}

/// What one scan shows by itself.
void add_scan_figures(const Cloud& cloud, const ScanSighting& scan, const DieSighting* sighting,
                      const std::string& name, Page& page) {
  const std::optional<DrawnDie> die = drawn_die(scan, sighting);
  page.figures.push_back({"planes_" + name + ".png", "Planes, " + name,
                          "The scan as its scanner saw it, every plane in a colour of its own, the "
                          "largest numbered by "
                          "rank; grey belongs to no plane. Angles in degrees.",
                          planes_picture(cloud, scan.planes, name,
                                         die ? std::optional(die->centre_m()) : std::nullopt)});
  if (!die) return;
  page.figures.push_back(
      {"facets_" + name + ".png", "Facets, " + name,
       fmt::format(
           "Points of the three facets: green carried the fit, grey lies within {:.0f} mm of a "
           "border "
           "or beyond it, orange on a pip, red off the plane. Above each facet: points used of "
           "points near it, RMSE along the normal. Metres from the die's corner.",
           die->trim_m * 1e3),
       facets_picture(cloud, *die, name)});
  page.figures.push_back(
      {"pips_" + name + ".png", "Pips, " + name,
       "One row for each facet: the stages of the published chain (mean intensity, low-passed, "
       "Otsu's "
       "threshold, Canny's edges, clusters that count), then the reader's decision: circles where "
       "it sees pips, dots where it sees none. The facet's corner is at the lower left.",
       pips_picture(cloud, *die)});
}

void add_pair_figures(const StagedDieRegistration& staged, Page& page) {
  const DieStages& stages = staged.stages;
  page.figures.push_back({"frames.png", "Corner frames",
                          "The die with the frame of the corner that each scan sees; an axis is "
                          "named by the facets that "
                          "meet in it. Light edges are the parallelepiped's hidden ones. Metres.",
                          frames_picture(staged)});
  if (!staged.registration.master_from_slave) return;
  const RigidTransform& transform = *staged.registration.master_from_slave;
  const DrawnDie die = *drawn_die(stages.of_master, &stages.pair->master);
  page.figures.push_back(
      {"registered.png", "Both scans after the registration",
       "Cuts 10 cm thick through the die's centre, level and upright: the scene, and close to the "
       "die. What does not fit together shows as a double line. Metres, master frame.",
       overlay_picture(stages.master, stages.slave, transform,
                       {.about_m = die.centre_m(), .close_radius_m = 1.2 * die.longest_edge_m()})});
  const auto& checks = staged.registration.check_planes;
  if (checks.empty()) return;
  page.figures.push_back(
      {"check_planes.png", "Distances from the master's planes",
       "The largest planes that both scans see: distance of each point from the plane fitted to "
       "the "
       "master's points, above of the master's own, below of the slave's after the "
       "registration. Metres in the plane, colours in mm.",
       check_plane_maps(stages.master, stages.slave, stages.planes, checks, transform)});
  page.figures.push_back({"check_plane_chart.png", "Residuals of the planes",
                          "RMSE of each scan alone and of both together, and the absolute offset "
                          "between the two, mm.",
                          check_plane_chart(checks)});
}

}  // namespace

Page die_page(const StagedDieRegistration& staged, const std::string& master_name,
              const std::string& slave_name) {
  const Registration& registration = staged.registration;
  const DieStages& stages = staged.stages;
  Page page;
  page.title = fmt::format("Die registration: {} from {}", master_name, slave_name);
  page.refused = registration.refusal.has_value();
  page.verdict = page.refused
                     ? fmt::format("refused ({}): {}", to_string(registration.refusal->code),
                                   registration.refusal->message)
                     : fmt::format("registered by {}", registration.method);
  page.notes = registration.warnings;
  if (registration.master_from_slave) page.tables.push_back(transform_table(registration));
  if (registration.die) {
    page.tables.push_back(facet_table(*registration.die));
    page.tables.push_back(angle_table(*registration.die));
  }
  if (!registration.check_planes.empty())
    page.tables.push_back(plane_table(registration.check_planes));
  add_scan_figures(stages.master, stages.of_master, stages.pair ? &stages.pair->master : nullptr,
                   "master", page);
  add_scan_figures(stages.slave, stages.of_slave, stages.pair ? &stages.pair->slave : nullptr,
                   "slave", page);
  if (stages.pair) add_pair_figures(staged, page);
  return page;
}

}  // namespace alea
