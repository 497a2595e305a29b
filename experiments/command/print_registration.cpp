#include <fmt/format.h>

#include <cmath>

#include "alea/core/angle.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

constexpr double shown_margin = 30;  // orientations less likely by more are in the JSON only

void print_transform(const Registration& registration) {
  const RigidTransform& t = *registration.master_from_slave;
  fmt::print("registered by {}\nmaster_from_slave (p_master = R p_slave + t, metres)\n",
             registration.method);
  const Eigen::Matrix4d m = t.matrix();
  for (int i = 0; i < 4; ++i)
    fmt::print("  {:13.9f} {:13.9f} {:13.9f} {:14.6f}\n", m(i, 0), m(i, 1), m(i, 2), m(i, 3));
  const Eigen::Vector3d angles = omega_phi_kappa_rad(t.rotation) * deg_per_rad;
  fmt::print("  omega, phi, kappa (deg; R = Rz(kappa) Ry(phi) Rx(omega)): {:.5f} {:.5f} {:.5f}\n",
             angles.x(), angles.y(), angles.z());
  if (!registration.covariance) return;
  const Vector6d sd = registration.covariance->covariance.diagonal().cwiseSqrt();
  const Eigen::Vector3d& about = registration.covariance->about_m;
  fmt::print(
      "  standard deviation: rotation {:.5f} {:.5f} {:.5f} deg, translation {:.3f} {:.3f} {:.3f} "
      "mm, about "
      "({:.3f}, {:.3f}, {:.3f}) m\n",
      sd[0] * deg_per_rad, sd[1] * deg_per_rad, sd[2] * deg_per_rad, sd[3] * 1e3, sd[4] * 1e3,
      sd[5] * 1e3, about.x(), about.y(), about.z());
}

void print_die(const DieReport& die) {
  fmt::print("die\n");
  for (const FacetReport& facet : die.facets)
    fmt::print("  {:<6} facet {} ({} points, {:.2f} mm RMSE, pip probability {:.4f})\n",
               facet.in_master ? "master" : "slave", facet.pips, facet.points, facet.rmse_m * 1e3,
               facet.pip_probability);
  const auto print_angles = [](const char* scan, const std::map<std::string, double>& angles_rad) {
    fmt::print("  {:<6} angles", scan);
    for (const auto& [edge, angle] : angles_rad)
      fmt::print("  {}: {:.3f} deg", edge, angle * deg_per_rad);
    fmt::print("\n");
  };
  print_angles("master", die.angles_master_rad);
  print_angles("slave", die.angles_slave_rad);
  if (die.shared_edge && die.edge_m)
    fmt::print("  edge {}: {:.5f} m{}\n", *die.shared_edge, *die.edge_m,
               die.calibrated ? " (calibrated)" : "");
}

void print_adjustment(const AdjustmentReport& report) {
  fmt::print("adjustment of {} scans: chi-square {:.2f} on {} (p {:.3g})\n", report.scans,
             report.chi_square, report.freedom, report.p_value);
  for (const VarianceComponent& component : report.components)
    fmt::print("  {:<12} {:<8} actual variance {:.3f} of the assumed (redundancy {:.1f})\n",
               component.group,
               component.scan
                   ? (*component.scan == 0 ? "master" : fmt::format("scan {}", *component.scan + 1))
                   : "",
               component.factor, component.freedom);
  for (const std::string& open : report.open) fmt::print("  not observable: {}\n", open);
}

void print_site(const SiteTie& site) {
  fmt::print("site_from_master (control points, {:.2f} mm RMSE)\n", site.rmse_m * 1e3);
  const Eigen::Matrix4d m = site.site_from_master.matrix();
  for (int i = 0; i < 4; ++i)
    fmt::print("  {:13.9f} {:13.9f} {:13.9f} {:14.6f}\n", m(i, 0), m(i, 1), m(i, 2), m(i, 3));
  for (const ControlResidual& point : site.points)
    fmt::print("  {:<12} residual {:8.2f} {:8.2f} {:8.2f} mm\n", point.name,
               point.residual_m.x() * 1e3, point.residual_m.y() * 1e3, point.residual_m.z() * 1e3);
}

}  // namespace

void print_check_planes(const std::vector<CheckPlane>& planes) {
  if (planes.empty()) return;
  fmt::print("planes that both scans see (mm; offset = slave minus master)\n");
  fmt::print("  {:>3} {:<11} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>10}\n", "id", "role",
             "points M", "points S", "alone M", "alone S", "union", "offset", "tilt (deg)");
  for (const CheckPlane& plane : planes)
    fmt::print("  {:>3} {:<11} {:>9} {:>9} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>10.4f}\n",
               plane.id, plane.role == CheckPlaneRole::check ? "check" : "calibration",
               plane.points_master, plane.points_slave, plane.alone_master_m * 1e3,
               plane.alone_slave_m * 1e3, plane.union_m * 1e3, plane.offset_m * 1e3,
               plane.tilt_rad * deg_per_rad);
}

/// What was possible beside the answer.
void print_orientations(const AmbiguityReport& ambiguity) {
  fmt::print("{} orientations of the die are about as likely by its pips\n",
             ambiguity.alternatives + 1);
  for (const OrientationReport& each : ambiguity.orientations) {
    if (each.log_likelihood_margin > shown_margin) continue;
    const Eigen::Vector3d angles =
        omega_phi_kappa_rad(each.master_from_slave.rotation) * deg_per_rad;
    fmt::print("  omega, phi, kappa {:8.1f} {:8.1f} {:8.1f} deg, log-likelihood {:.1f} lower{}\n",
               angles.x(), angles.y(), angles.z(), each.log_likelihood_margin,
               each.scene_points
                   ? fmt::format(", {:.0f} points of the scene agree", *each.scene_points)
                   : "");
  }
}

void print_registration(const Registration& registration) {
  for (const std::string& warning : registration.warnings)
    fmt::print(stderr, "alea: warning: {}\n", warning);
  const auto& ambiguity = registration.ambiguity;
  if (ambiguity && (ambiguity->alternatives > 0 || ambiguity->resolved_by_scene) &&
      !ambiguity->orientations.empty())
    print_orientations(*ambiguity);
  if (!registration.master_from_slave) return;
  print_transform(registration);
  if (registration.die) print_die(*registration.die);
  if (const auto& refined = registration.refinement)
    fmt::print(
        "refined by {} on {} calibration planes: turned by {:.5f} deg, the die moved by {:.3f} "
        "mm\n",
        refined->method, refined->planes, refined->rotation_rad * deg_per_rad,
        refined->translation_m.norm() * 1e3);
  if (registration.adjustment) print_adjustment(*registration.adjustment);
  if (registration.site) print_site(*registration.site);
  print_check_planes(registration.check_planes);
}

}  // namespace alea::command
