#include <fmt/format.h>

#include "alea/core/angle.hpp"
#include "experiments/markerless/twin_scene.hpp"

namespace alea::experiments::markerless {
namespace {

std::string vector(const Eigen::Vector3d& v) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x(), v.y(), v.z());
}

std::string pose(const char* place, const RigidTransform& scene_from_object) {
  const Eigen::Vector3d angles = omega_phi_kappa_rad(scene_from_object.rotation) * deg_per_rad;
  return fmt::format("{} = {}\nomega_phi_kappa_deg = {}\n", place,
                     vector(scene_from_object.translation), vector(angles));
}

std::string scanner(const Station& station) {
  const Scanner& s = station.scanner;
  return fmt::format(
      "[scanner]\nrange_noise_m = {:.9g}\ngrazing_m = {:.9g}\nsurface_m = {:.9g}\n"
      "angular_noise_arcsec = {:.9g}\nintensity_noise = {:.9g}\nmax_range_m = {:.9g}\n",
      s.noise.range_noise_m, s.noise.grazing_m, s.noise.surface_m,
      s.noise.angular_noise_rad * deg_per_rad * 3600, s.intensity_noise, s.max_range_m);
}

std::string of_station(const Station& station) {
  const auto range = [](const AngleRange& r) {
    return fmt::format("[{:.9g}, {:.9g}]", r.start_rad * deg_per_rad, r.stop_rad * deg_per_rad);
  };
  return fmt::format("\n[[station]]\nname = \"{}\"\n", station.name) +
         pose("position_m", station.scene_from_scan) +
         fmt::format("azimuth_deg = {}\nelevation_deg = {}\nstep_mrad = {:.9g}\n",
                     range(station.azimuth), range(station.elevation),
                     station.azimuth.step_rad * 1e3);
}

}  // namespace

std::string as_toml(const Scene& scene, const std::string& title) {
  std::string text = fmt::format("title = \"{}\"\n\n{}", title, scanner(scene.stations.at(0)));
  for (const Patch& p : scene.patches)
    text += fmt::format(
        "\n[[patch]]\nid = \"{}\"\ncorner_m = {}\nside_u_m = {}\nside_v_m = {}\nintensity = "
        "{:.9g}\n",
        p.id, vector(p.corner_m), vector(p.side_u_m), vector(p.side_v_m), p.intensity);
  for (const Box& b : scene.boxes)
    text += fmt::format("\n[[box]]\nid = \"{}\"\n{}size_m = {}\nintensity = {:.9g}\n", b.id,
                        pose("centre_m", b.scene_from_box), vector(b.size_m), b.intensity);
  for (const Cylinder& c : scene.cylinders) {
    text +=
        fmt::format("\n[[cylinder]]\nid = \"{}\"\nbase_m = {}\naxis_m = {}\nradius_m = {:.9g}\n",
                    c.id, vector(c.base_m), vector(c.axis_m), c.radius_m);
    if (c.top_radius_m) text += fmt::format("top_radius_m = {:.9g}\n", *c.top_radius_m);
    text += fmt::format("intensity = {:.9g}\n", c.intensity);
  }
  for (const Sphere& s : scene.spheres)
    text += fmt::format(
        "\n[[sphere]]\nid = \"{}\"\ncentre_m = {}\nradius_m = {:.9g}\nintensity = {:.9g}\n", s.id,
        vector(s.centre_m), s.radius_m, s.intensity);
  for (const Station& station : scene.stations) text += of_station(station);
  return text;
}

}  // namespace alea::experiments::markerless
