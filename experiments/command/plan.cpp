#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/report/plan_picture.hpp"
#include "alea/simulate/scene_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/plan_json.hpp"
#include "experiments/command/read_registration.hpp"
#include "experiments/engine/folder.hpp"

namespace alea::command {
namespace {

struct PlanArguments {
  CommonOptions common;
  std::string scene, out, measured, estimator, shape, facets;
  std::optional<double> tolerance_mm, ring_m, height_m, grid_m, edge_sd_m, level_sd_arcsec;
};

void require_positive(const std::optional<double>& value, const char* option) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw usage_error(fmt::format("{}: {} is not a positive number", option, *value));
}

void check_arguments(const PlanArguments& arguments) {
  require_positive(arguments.tolerance_mm, "--tolerance-mm");
  require_positive(arguments.ring_m, "--ring");
  require_positive(arguments.grid_m, "--grid");
  require_positive(arguments.level_sd_arcsec, "--level-sd-arcsec");
  if (arguments.edge_sd_m && !(*arguments.edge_sd_m >= 0 && std::isfinite(*arguments.edge_sd_m)))
    throw usage_error("--edge-sd: a standard deviation is not negative; give metres");
  if (arguments.height_m && !std::isfinite(*arguments.height_m))
    throw usage_error("--height: give metres in the scene's frame");
}

void require_stations_and_target(const std::string& path, const Scene& scene) {
  if (scene.stations.size() < 2)
    throw input_error(
        fmt::format("{}: a registration needs two stations; add a [[station]]", path));
  const bool planes =
      std::any_of(scene.patches.begin(), scene.patches.end(),
                  [](const Patch& patch) { return patch.role == PatchRole::calibration; });
  if (scene.dice.empty() && scene.spheres.empty() && !planes)
    throw input_error(fmt::format(
        "{}: no target; add a [[die]], a [[sphere]] or a plane with the role calibration", path));
}

/// The request of the scene file, as far as the options do not say otherwise.
PlanRequest request_of(const PlanArguments& arguments, const Scene& scene) {
  PlanRequest request = load_plan(arguments.scene, scene);
  PlanAssumptions& assumptions = request.assumptions;
  if (arguments.tolerance_mm) request.tolerance_m = *arguments.tolerance_mm * 1e-3;
  if (arguments.ring_m) request.ring_m = *arguments.ring_m;
  if (arguments.height_m) request.area.height_m = *arguments.height_m;
  if (arguments.grid_m) request.grid_m = *arguments.grid_m;
  if (arguments.edge_sd_m) assumptions.edge_sd_m = *arguments.edge_sd_m;
  if (arguments.level_sd_arcsec)
    assumptions.level_sd_rad = *arguments.level_sd_arcsec / 3600 * std::numbers::pi / 180;
  if (!arguments.estimator.empty()) assumptions.jointly = arguments.estimator == "adjustment";
  if (!arguments.shape.empty()) assumptions.shape_known = arguments.shape == "known";
  if (!arguments.facets.empty()) assumptions.fitted_facets = arguments.facets == "fitted";
  return request;
}

std::vector<PairPlan> plan_of(const PlanResult& plan) {
  const PlanAssumptions& assumptions = plan.request.assumptions;
  const RigidTransform master_from_scene = plan.scene.stations.front().scene_from_scan.inverse();
  const Eigen::Vector3d up = master_from_scene.rotation.col(2);
  PlanAssumptions fitted = assumptions;
  fitted.fitted_facets = true;
  const bool has_die = assumptions.dice && !plan.scene.dice.empty();
  const std::vector<PlannedPair> planned = plan_pairs(plan.scene, assumptions);
  const std::vector<PlannedPair> as_fitted =
      has_die ? plan_pairs(plan.scene, fitted) : std::vector<PlannedPair>{};
  std::vector<PairPlan> pairs;
  for (std::size_t k = 0; k < planned.size(); ++k) {
    PairPlan pair;
    pair.slave = planned[k].slave;
    pair.reach_m = reach_m(plan.scene, assumptions,
                           {pair.slave, plan.request.tolerance_m, plan.request.ring_m});
    if (planned[k].covariance) {
      pair.covariance = *planned[k].covariance;
      pair.accuracy = pose_accuracy(*pair.covariance, up);
      pair.map = error_map(*pair.covariance, master_from_scene, plan.request.area);
      if (has_die && as_fitted[k].covariance)
        pair.fitted = pose_accuracy(*as_fitted[k].covariance, up);
    } else {
      pair.refusal = planned[k].covariance.refusal();
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<DiePosition> search(const PlanResult& plan, const ProgressCallback& progress) {
  const PlanRequest& request = plan.request;
  std::vector<Eigen::Vector3d> places = request.positions_m;
  if (places.empty() && request.grid_m > 0)
    places = free_floor_positions(plan.scene, request.area, request.grid_m);
  if (places.empty()) return {};
  return rank_die_positions(plan.scene, request.assumptions, request.area, places,
                            request.turns_rad, progress);
}

std::string map_csv(const ErrorMap& map) {
  std::string text = "x_m,y_m,z_m,rms_error_m\n";
  for (int row = 0; row < map.area.rows(); ++row)
    for (int column = 0; column < map.area.columns(); ++column) {
      const Eigen::Vector3d at = map.area.at(column, row);
      text +=
          fmt::format("{:.6g},{:.6g},{:.6g},{:.6e}\n", at.x(), at.y(), at.z(), map.at(column, row));
    }
  return text;
}

PlanDrawing drawing_of(PairPlan& pair, const PlanResult& plan,
                       const std::vector<MeasuredRegistration>& measured) {
  PlanDrawing drawing;
  drawing.map = *pair.map;
  drawing.tolerance_m = plan.request.tolerance_m;
  drawing.slave = pair.slave;
  if (!plan.positions.empty() && !plan.positions.front().refusal)
    drawing.best_die = plan.positions.front().centre_m;
  if (pair.slave > measured.size()) return drawing;
  const MeasuredRegistration& registration = measured[pair.slave - 1];
  const RigidTransform& scene_from_master = plan.scene.stations.front().scene_from_scan;
  pair.checks = check_plan(*pair.covariance, registration.check_planes);
  for (PlanCheck& check : pair.checks) check.centroid_m = scene_from_master * check.centroid_m;
  drawing.checks = pair.checks;
  if (registration.covariance)
    drawing.achieved =
        error_map(*registration.covariance, scene_from_master.inverse(), pair.map->area);
  return drawing;
}

void write_maps(PlanResult& plan, const std::filesystem::path& folder,
                const std::vector<MeasuredRegistration>& measured) {
  for (PairPlan& pair : plan.pairs) {
    if (!pair.map) continue;
    const std::filesystem::path base = folder / ("map_" + plan.scene.stations[pair.slave].name);
    const PlanDrawing drawing = drawing_of(pair, plan, measured);
    write_file_atomically(base.string() + ".csv", map_csv(*pair.map));
    write_png(base.string() + ".png", draw_plan(plan.scene, drawing));
    plan.files.push_back(base.string() + ".csv");
    plan.files.push_back(base.string() + ".png");
  }
}

int run(const PlanArguments& arguments) {
  check_arguments(arguments);
  const ThreadLimit limit(arguments.common.threads);
  PlanResult plan;
  plan.scene = load_scene(arguments.scene);
  require_stations_and_target(arguments.scene, plan.scene);
  plan.request = request_of(arguments, plan.scene);
  std::vector<MeasuredRegistration> measured;
  if (!arguments.measured.empty()) measured = read_registrations(arguments.measured);
  plan.pairs = plan_of(plan);
  plan.facets = planned_facets(plan.scene, plan.request.assumptions);
  plan.positions = search(plan, make_progress(arguments.common));
  experiments::make_folder(arguments.out);
  write_maps(plan, arguments.out, measured);
  plan.files.push_back((std::filesystem::path(arguments.out) / "plan.json").string());
  const nlohmann::json document = plan_json(plan);
  write_file_atomically(plan.files.back(), document.dump(2) + "\n");
  write_json(arguments.common, document);
  if (arguments.common.json != "-") print_plan(plan);
  for (const PairPlan& pair : plan.pairs)
    if (pair.refusal) return report_refusal(*pair.refusal);
  return exit_done;
}

}  // namespace

void add_plan(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<PlanArguments>();
  CLI::App* app = parent.add_subcommand(
      "plan", "Predict how well the stations of a scene can be registered, before measuring");
  PlanArguments& a = *arguments;
  app->add_option("SCENE", a.scene, "Scene file (TOML): stations, targets, noise, table [plan]")
      ->required();
  app->add_option("--out", a.out, "Folder for plan.json and the maps; made if missing")->required();
  app->add_option("--tolerance-mm", a.tolerance_mm,
                  "RMS error asked for (mm); default 2.5 or the scene's");
  app->add_option("--ring", a.ring_m,
                  "Radius of the ring about the die on which the tolerance is to hold (m); "
                  "default 10 or the scene's");
  app->add_option("--height", a.height_m, "Height of the map (m, scene frame); default 1.5");
  app->add_option("--grid", a.grid_m,
                  "Try the die on a grid of free floor positions of this spacing (m)");
  app->add_option("--estimator", a.estimator,
                  "adjustment: all stations at once (default); closed_form: each slave with the "
                  "master alone")
      ->check(CLI::IsMember({"adjustment", "closed_form"}));
  app->add_option("--shape", a.shape,
                  "free: tilts and sizes unknown but for the shared edge (default); known: a "
                  "calibrated die")
      ->check(CLI::IsMember({"free", "known"}));
  app->add_option("--facets", a.facets,
                  "whole: the bound (default); fitted: without the borders and pips that register "
                  "die leaves out")
      ->check(CLI::IsMember({"whole", "fitted"}));
  app->add_option("--edge-sd", a.edge_sd_m, "Standard deviation of the shared edges (m)");
  app->add_option(
      "--level-sd-arcsec", a.level_sd_arcsec,
      "The scanners are levelled with this standard deviation (arc seconds, each axis)");
  app->add_option("--measured", a.measured,
                  "JSON of `alea register`: its check planes are set beside the prediction");
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
