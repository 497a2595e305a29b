#include "alea/evaluate/plan_file.hpp"

#include <cmath>

#include "alea/core/angle.hpp"
#include "alea/io/toml_table.hpp"

namespace alea {
namespace {

constexpr double arc_second = deg / 3600;

void read_assumptions(const TomlTable& table, PlanAssumptions& out) {
  out.shape_known = table.choice("shape", 0, {"free", "known"}) == 1;
  out.fitted_facets = table.choice("facets", 0, {"whole", "fitted"}) == 1;
  out.jointly = table.choice("estimator", 0, {"adjustment", "closed_form"}) == 0;
  out.edge_sd_m = table.number("edge_sd_m", out.edge_sd_m, Allowed::not_negative);
  if (table.has("level_sd_arcsec"))
    out.level_sd_rad = arc_second * table.number("level_sd_arcsec", 0, Allowed::positive);
  if (!table.has("targets")) return;
  out.dice = out.spheres = out.planes = false;
  for (const std::string& target : table.texts("targets")) {
    if (target == "dice")
      out.dice = true;
    else if (target == "spheres")
      out.spheres = true;
    else if (target == "planes")
      out.planes = true;
    else
      table.fail("targets", "some of dice, spheres, planes");
  }
}

void read_area(const TomlTable& table, const Scene& scene, MapArea& area) {
  const double cell_m = table.number("cell_m", area.cell_m, Allowed::positive);
  area = area_of(scene, table.number("height_m", area.height_m), cell_m);
  const Eigen::Vector2d x = table.interval("x_m", {area.low_m.x(), area.high_m.x()});
  const Eigen::Vector2d y = table.interval("y_m", {area.low_m.y(), area.high_m.y()});
  if (!(x[1] > x[0])) table.fail("x_m", "an interval of positive length");
  if (!(y[1] > y[0])) table.fail("y_m", "an interval of positive length");
  area.low_m = {x[0], y[0]};
  area.high_m = {x[1], y[1]};
  constexpr double most_cells = 1e6;
  if ((area.high_m - area.low_m).prod() / (area.cell_m * area.cell_m) > most_cells)
    table.fail("cell_m", "cells large enough that the map has at most a million");
}

std::vector<double> turns(double step_deg) {
  std::vector<double> out;
  for (double turn = 0; turn < 90 - 1e-9; turn += step_deg) out.push_back(turn * deg);
  return out;
}

}  // namespace

PlanRequest load_plan(const std::filesystem::path& path, const Scene& scene) {
  PlanRequest request;
  request.area = area_of(scene);
  request.turns_rad = turns(15);
  const TomlTable file = TomlTable::read(path);
  const auto table = file.table("plan");
  if (!table) return request;
  read_assumptions(*table, request.assumptions);
  read_area(*table, scene, request.area);
  request.tolerance_m = table->number("tolerance_m", request.tolerance_m, Allowed::positive);
  request.ring_m = table->number("ring_m", request.ring_m, Allowed::positive);
  request.grid_m = table->number("grid_m", request.grid_m, Allowed::not_negative);
  const double step_deg = table->number("turn_step_deg", 15, Allowed::positive);
  if (step_deg < 1) table->fail("turn_step_deg", "at least one degree");
  request.turns_rad = turns(step_deg);
  for (const TomlTable& position : table->tables("position")) {
    request.positions_m.push_back(position.vector3("centre_m"));
    position.finish();
  }
  table->finish();
  return request;
}

}  // namespace alea
