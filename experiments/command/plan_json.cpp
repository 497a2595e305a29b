#include "experiments/command/plan_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "alea/core/angle.hpp"
#include "alea/core/version.hpp"
#include "experiments/command/json_parts.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

json accuracy_json(const PoseAccuracy& accuracy) {
  return {{"rotation_rad", accuracy.rotation_rad},
          {"translation_m", accuracy.translation_m},
          {"ring5_m", accuracy.ring5_m},
          {"ring10_m", accuracy.ring10_m}};
}

json pair_json(const PairPlan& pair, const PlanResult& plan) {
  json out = {{"master", plan.scene.stations.front().name},
              {"slave", plan.scene.stations[pair.slave].name},
              {"refusal", refusal_json(pair.refusal)},
              {"covariance", nullptr},
              {"covariance_about_m", nullptr},
              {"accuracy", nullptr},
              {"accuracy_of_fitted_facets", nullptr},
              {"room", nullptr},
              {"reach_m", optional_json(pair.reach_m)},
              {"checks", json::array()}};
  for (const PlanCheck& check : pair.checks)
    out["checks"].push_back({{"id", check.id},
                             {"centroid_m", vector_json(check.centroid_m)},
                             {"offset_m", check.offset_m},
                             {"predicted_sd_m", check.predicted_sd_m}});
  if (!pair.covariance) return out;
  out["covariance"] = matrix_json(pair.covariance->covariance);
  out["covariance_about_m"] = vector_json(pair.covariance->about_m);
  out["accuracy"] = accuracy_json(pair.accuracy);
  if (pair.fitted) out["accuracy_of_fitted_facets"] = accuracy_json(*pair.fitted);
  out["room"] = {{"rms_m", pair.map->root_mean_square_m()},
                 {"largest_m", pair.map->largest_m()},
                 {"share_within_tolerance", pair.map->share_within(plan.request.tolerance_m)}};
  return out;
}

json assumptions_json(const PlanAssumptions& assumptions) {
  json targets = json::array();
  if (assumptions.dice) targets.push_back("dice");
  if (assumptions.spheres) targets.push_back("spheres");
  if (assumptions.planes) targets.push_back("planes");
  return {{"shape", assumptions.shape_known ? "known" : "free"},
          {"estimator", assumptions.jointly ? "adjustment" : "closed_form"},
          {"facets", assumptions.fitted_facets ? "fitted" : "whole"},
          {"edge_sd_m", assumptions.edge_sd_m},
          {"level_sd_rad", std::isfinite(assumptions.level_sd_rad) ? json(assumptions.level_sd_rad)
                                                                   : json(nullptr)},
          {"targets", targets}};
}

bool any_refused(const PlanResult& plan) {
  for (const PairPlan& pair : plan.pairs)
    if (pair.refusal) return true;
  return false;
}

json refusal_of(const PlanResult& plan) {
  for (const PairPlan& pair : plan.pairs)
    if (pair.refusal) return refusal_json(pair.refusal);
  return nullptr;
}

void print_pair(const PairPlan& pair, const PlanResult& plan) {
  const auto& stations = plan.scene.stations;
  const std::string names =
      fmt::format("{} -> {}", stations[pair.slave].name, stations.front().name);
  if (pair.refusal) {
    fmt::print("{}: refused ({}): {}\n", names, to_string(pair.refusal->code),
               pair.refusal->message);
    return;
  }
  const auto line = [](const PoseAccuracy& a) {
    return fmt::format(
        "rotation {:.4f} deg, at the target {:.3f} mm, on the 5 m ring {:.2f} mm, 10 m {:.2f} mm",
        a.rotation_rad * deg_per_rad, a.translation_m * 1e3, a.ring5_m * 1e3, a.ring10_m * 1e3);
  };
  fmt::print("{}: {}\n", names, line(pair.accuracy));
  if (pair.fitted)
    fmt::print("  from the part of the facets that register die fits: {}\n", line(*pair.fitted));
  fmt::print("  room at z = {:g} m: RMS {:.2f} mm, largest {:.2f} mm, {:.0f} % within {:g} mm\n",
             plan.request.area.height_m, pair.map->root_mean_square_m() * 1e3,
             pair.map->largest_m() * 1e3, 100 * pair.map->share_within(plan.request.tolerance_m),
             plan.request.tolerance_m * 1e3);
  if (pair.reach_m)
    fmt::print("  {:g} mm on the {:g} m ring holds up to {:.1f} m from the die\n",
               plan.request.tolerance_m * 1e3, plan.request.ring_m, *pair.reach_m);
  for (const PlanCheck& check : pair.checks)
    fmt::print("  check plane {}: offset {:+.2f} mm, predicted sd {:.2f} mm\n", check.id,
               check.offset_m * 1e3, check.predicted_sd_m * 1e3);
}

void print_positions(const PlanResult& plan) {
  if (plan.positions.empty()) return;
  fmt::print("best of {} places of the die (centre, turn, room RMS of the worst slave):\n",
             plan.positions.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(5, plan.positions.size()); ++i) {
    const DiePosition& place = plan.positions[i];
    if (place.refusal) break;
    fmt::print("  ({:.2f}, {:.2f}, {:.2f}) m, {:.0f} deg: {:.2f} mm\n", place.centre_m.x(),
               place.centre_m.y(), place.centre_m.z(), place.turn_rad * deg_per_rad,
               place.room_rms_m * 1e3);
  }
}

}  // namespace

json plan_json(const PlanResult& plan) {
  const auto& stations = plan.scene.stations;
  json facets = json::array(), pairs = json::array(), positions = json::array();
  for (const PlannedFacet& facet : plan.facets)
    facets.push_back({{"station", stations[facet.station].name},
                      {"pips", facet.pips},
                      {"points", facet.points},
                      {"incidence_rad", facet.incidence_rad}});
  for (const PairPlan& pair : plan.pairs) pairs.push_back(pair_json(pair, plan));
  for (const DiePosition& place : plan.positions)
    positions.push_back({{"centre_m", vector_json(place.centre_m)},
                         {"turn_rad", place.turn_rad},
                         {"room_rms_m", place.refusal ? json(nullptr) : json(place.room_rms_m)},
                         {"refusal", refusal_json(place.refusal)}});
  const MapArea& area = plan.request.area;
  return {{"alea", version()},
          {"status", any_refused(plan) ? "refused" : "planned"},
          {"refusal", refusal_of(plan)},
          {"assumptions", assumptions_json(plan.request.assumptions)},
          {"tolerance_m", plan.request.tolerance_m},
          {"ring_m", plan.request.ring_m},
          {"area",
           {{"x_m", {area.low_m.x(), area.high_m.x()}},
            {"y_m", {area.low_m.y(), area.high_m.y()}},
            {"height_m", area.height_m},
            {"cell_m", area.cell_m}}},
          {"facets", facets},
          {"pairs", pairs},
          {"positions", positions},
          {"files", plan.files}};
}

void print_plan(const PlanResult& plan) {
  for (const PlannedFacet& facet : plan.facets)
    fmt::print("{}: facet {}: about {:.0f} points, incidence {:.0f} deg\n",
               plan.scene.stations[facet.station].name, facet.pips, facet.points,
               facet.incidence_rad * deg_per_rad);
  for (const PairPlan& pair : plan.pairs) print_pair(pair, plan);
  print_positions(plan);
  for (const std::string& file : plan.files) fmt::print("wrote {}\n", file);
}

}  // namespace alea::command
