#include "alea/simulate/scene_file_parts.hpp"

#include <fmt/format.h>

#include <numbers>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"

namespace alea {
namespace {

constexpr double arc_second = deg / 3600;

PipStyle read_pips(const TomlTable& table) {
  PipStyle pips;
  pips.painted = table.flag("painted", pips.painted);
  pips.radius_share = table.number("radius_share", pips.radius_share, Allowed::positive);
  pips.spacing_share = table.number("spacing_share", pips.spacing_share, Allowed::positive);
  pips.recess_m = table.number("recess_m", pips.recess_m, Allowed::not_negative);
  pips.intensity = table.number("intensity", pips.intensity, Allowed::not_negative);
  pips.turned_2 = table.flag("turned_2", pips.turned_2);
  pips.turned_3 = table.flag("turned_3", pips.turned_3);
  pips.turned_6 = table.flag("turned_6", pips.turned_6);
  table.finish();
  return pips;
}

void read_facet(const TomlTable& table, std::array<FacetShape, 6>& facets) {
  table.require("pips");
  FacetShape& facet = facets[table.integer("pips", 1, 1, 6) - 1];
  facet.tilt_u_rad = deg * table.number("tilt_u_deg", 0);
  facet.tilt_v_rad = deg * table.number("tilt_v_deg", 0);
  facet.offset_m = table.number("offset_m", 0);
  facet.bow_m = table.number("bow_m", 0);
  table.finish();
}

RigidTransform read_die_pose(const TomlTable& table, Chirality chirality) {
  const bool stands = table.has("up") || table.has("front") || table.has("front_azimuth_deg");
  if (!stands) return read_pose(table, "centre_m");
  if (table.has("omega_phi_kappa_deg"))
    table.fail("omega_phi_kappa_deg", "either this or up, front and front_azimuth_deg");
  const auto up = static_cast<int>(table.integer("up", 1, 1, 6));
  const auto front = static_cast<int>(table.integer("front", up == 2 || up == 5 ? 3 : 2, 1, 6));
  if (front == up || front + up == 7)
    table.fail("front", "a facet that meets the upper one in an edge");
  return standing_pose(chirality, up, front, deg * table.number("front_azimuth_deg", 0),
                       table.vector3("centre_m"));
}

}  // namespace

RigidTransform read_pose(const TomlTable& table, const std::string& centre_key) {
  const Eigen::Vector3d angles = table.vector3("omega_phi_kappa_deg", Eigen::Vector3d::Zero());
  return {rotation_from_omega_phi_kappa(angles * deg), table.vector3(centre_key)};
}

Eigen::Vector3d read_size(const TomlTable& table, const std::string& key,
                          const Eigen::Vector3d& missing) {
  const Eigen::Vector3d size = table.vector3(key, missing);
  if (!(size.minCoeff() > 0)) table.fail(key, "three positive lengths in metres");
  return size;
}

Die read_die(const TomlTable& table, std::size_t number) {
  DieModel model;
  model.id = table.text("id", number == 1 ? "die" : fmt::format("die {}", number));
  if (table.has("edge_m") && table.has("size_m")) table.fail("size_m", "either edge_m or size_m");
  const double edge = table.number("edge_m", model.size_m.x(), Allowed::positive);
  model.size_m = read_size(table, "size_m", Eigen::Vector3d::Constant(edge));
  model.chirality =
      static_cast<Chirality>(table.choice("chirality", 0, {"clockwise", "counterclockwise"}));
  model.edge_radius_m = table.number("edge_radius_m", 0, Allowed::not_negative);
  model.intensity = table.number("intensity", model.intensity, Allowed::not_negative);
  if (const auto pips = table.table("pips")) model.pips = read_pips(*pips);
  for (const TomlTable& facet : table.tables("facet")) read_facet(facet, model.facets);
  model.scene_from_die = read_die_pose(table, model.chirality);
  table.finish();
  try {
    return build_die(model);
  } catch (const Error& error) {
    table.fail("", fmt::format("a closed convex body ({})", error.what()));
  }
}

Scanner read_scanner(const TomlTable& table, const Scanner& base) {
  Scanner scanner = base;
  const auto length = [&table](const char* key, double missing) {
    return table.number(key, missing, Allowed::not_negative);
  };
  scanner.noise.range_noise_m = length("range_noise_m", base.noise.range_noise_m);
  scanner.noise.grazing_m = length("grazing_m", base.noise.grazing_m);
  scanner.noise.surface_m = length("surface_m", base.noise.surface_m);
  scanner.noise.angular_noise_rad =
      length("angular_noise_arcsec", base.noise.angular_noise_rad / arc_second) * arc_second;
  scanner.noise.range_growth = 1e-6 * length("range_growth_ppm", base.noise.range_growth * 1e6);
  scanner.beam_diameter_m = length("beam_diameter_m", base.beam_diameter_m);
  scanner.beam_divergence_rad =
      length("beam_divergence_mrad", base.beam_divergence_rad * 1e3) / 1e3;
  scanner.beam_rings = static_cast<int>(table.integer("beam_rings", base.beam_rings, 1, 10));
  scanner.mixed_pixels = table.flag("mixed_pixels", base.mixed_pixels);
  scanner.intensity_noise = length("intensity_noise", base.intensity_noise);
  scanner.min_range_m = length("min_range_m", base.min_range_m);
  scanner.max_range_m = table.number("max_range_m", base.max_range_m, Allowed::positive);
  table.finish();
  return scanner;
}

Station read_station(const TomlTable& table, std::size_t number, const Scanner& scanner,
                     const std::vector<std::pair<std::string, BoundingBall>>& targets) {
  const std::string name = table.text("name", fmt::format("scan{}", number));
  if (name.empty() || name.find_first_of("/\\") != std::string::npos)
    table.fail("name", "a name without slashes: it becomes the file's");
  const RigidTransform pose = read_pose(table, "position_m");
  const double step = table.number("step_mrad", 1, Allowed::positive) * 1e-3;
  Station station;
  if (table.has("aim_at")) {
    const std::string id = table.text("aim_at", "");
    const BoundingBall* target = nullptr;
    for (const auto& [target_id, ball] : targets)
      if (target_id == id) target = &ball;
    if (target == nullptr) table.fail("aim_at", "the id of an object of this scene");
    station = aimed_station(pose, *target, step);
  } else {
    const Eigen::Vector2d azimuth = table.interval("azimuth_deg", {-180, 180}) * deg;
    const Eigen::Vector2d elevation = table.interval("elevation_deg", {-60, 85}) * deg;
    if (azimuth[1] - azimuth[0] > 2 * std::numbers::pi * (1 + 1e-12))
      table.fail("azimuth_deg", "at most one turn");
    if (elevation.cwiseAbs().maxCoeff() > std::numbers::pi / 2 * (1 + 1e-12))
      table.fail("elevation_deg", "angles from -90 to 90");
    // A whole turn stops one step short, or the first column would come twice.
    const double full = azimuth[1] - azimuth[0] > 2 * std::numbers::pi - step / 2 ? step : 0;
    station.azimuth = {azimuth[0], azimuth[1] - full, step};
    station.elevation = {elevation[0], elevation[1], step};
  }
  station.name = name;
  station.scene_from_scan = pose;
  station.scanner = scanner;
  if (const auto own = table.table("scanner")) station.scanner = read_scanner(*own, scanner);
  table.finish();
  return station;
}

}  // namespace alea
