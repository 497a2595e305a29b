#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/calibrate_shape.hpp"
#include "experiments/command/calibrate.hpp"
#include "experiments/command/die_file.hpp"
#include "experiments/command/json_parts.hpp"
#include "experiments/command/noise_file.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct CalibrateDieArguments {
  CommonOptions common;
  std::vector<std::string> scans;
  double edge_m = 0, edge_sd_m = 0;
  std::string out, chirality = "clockwise", noise_file;
  bool without_planes = false, extents = false;
  ReadingOptions reading;
};

constexpr double smallest_edge_m = 0.02, largest_edge_m = 10;

ShapeCalibrationOptions calibration_options(const CalibrateDieArguments& arguments) {
  if (!(arguments.edge_m >= smallest_edge_m && arguments.edge_m <= largest_edge_m))
    throw usage_error(
        fmt::format("--edge: {} m is not the edge of a die; give metres from {} to {}",
                    arguments.edge_m, smallest_edge_m, largest_edge_m));
  ShapeCalibrationOptions options;
  options.die.edge_m = arguments.edge_m;
  if (arguments.edge_sd_m > 0) options.die.edge_sd_m = arguments.edge_sd_m;
  options.die.chirality = std::nullopt;
  if (arguments.chirality != "any")
    options.die.chirality =
        arguments.chirality == "clockwise" ? Chirality::clockwise : Chirality::counterclockwise;
  if (!arguments.noise_file.empty()) options.die.noise = read_noise_file(arguments.noise_file);
  options.die.seed = arguments.common.seed;
  options.use_planes = !arguments.without_planes;
  options.use_extents = arguments.extents;
  return options;
}

std::vector<Cloud> read_scans(const CalibrateDieArguments& arguments) {
  std::vector<Cloud> clouds(arguments.scans.size());
  const ReadOptions reading = read_options(arguments.reading);
  parallel_chunks(clouds.size(), 1, [&](std::size_t i, std::size_t) {
    clouds[i] = read_cloud(arguments.scans[i], reading);
    if (clouds[i].empty() || !clouds[i].has_intensity())
      throw input_error(fmt::format("{}: no {}; a scan with intensity is needed, to read the pips",
                                    arguments.scans[i],
                                    clouds[i].empty() ? "points" : "intensity"));
  });
  return clouds;
}

nlohmann::json calibration_json(const CalibrateDieArguments& arguments,
                                const Result<ShapeCalibration>& result) {
  nlohmann::json document = {{"status", result ? "calibrated" : "refused"},
                             {"refusal", nullptr},
                             {"die", nullptr},
                             {"seed", arguments.common.seed},
                             {"warnings", nlohmann::json::array()}};
  if (!result) {
    document["refusal"] = refusal_json(result.refusal());
    return document;
  }
  const DieAdjustment& adjusted = result->adjusted;
  document["warnings"] = result->warnings;
  document["scans"] = result->scans;
  document["scene_planes"] = result->planes;
  document["rank_defect"] = adjusted.defect;
  document["unobservable"] = adjusted.open;
  document["chi_square"] = adjusted.chi_square;
  document["freedom"] = adjusted.freedom;
  document["covariance_factor"] = adjusted.covariance_factor;
  document["die"] = die_json(adjusted, result->hand);
  return document;
}

void print_calibration(const ShapeCalibration& calibration) {
  const DieAdjustment& adjusted = calibration.adjusted;
  fmt::print("die from {} scans and {} pairs of scene planes: chi-square {:.1f} on {}\n",
             calibration.scans, calibration.planes, adjusted.chi_square, adjusted.freedom);
  for (const AdjustedAngle& angle : adjusted.angles)
    if (angle.angle_rad)
      fmt::print("  angle {}-{}: {:.4f} deg (sd {:.4f})\n", angle.edge.first_pips,
                 angle.edge.second_pips, *angle.angle_rad * deg_per_rad,
                 *angle.sd_rad * deg_per_rad);
  for (const AdjustedEdge& edge : adjusted.edges)
    if (edge.length_m)
      fmt::print("  edge {}-{}: {:.5f} m (sd {:.5f})\n", edge.edge.first_pips,
                 edge.edge.second_pips, *edge.length_m, *edge.sd_m);
  for (const std::string& open : adjusted.open) fmt::print("  {}\n", open);
}

int run(const CalibrateDieArguments& arguments) {
  const ShapeCalibrationOptions options = calibration_options(arguments);
  const ThreadLimit limit(arguments.common.threads);
  const std::vector<Cloud> clouds = read_scans(arguments);
  const auto result = calibrate_shape(clouds, options);
  const nlohmann::json document = calibration_json(arguments, result);
  if (result) write_file_atomically(arguments.out, document["die"].dump(2) + "\n");
  write_json(arguments.common, document);
  if (!result) return report_refusal(result.refusal());
  for (const std::string& warning : result->warnings)
    fmt::print(stderr, "alea: warning: {}\n", warning);
  if (arguments.common.json != "-") print_calibration(*result);
  return exit_done;
}

}  // namespace

void add_calibrate_die(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<CalibrateDieArguments>();
  CalibrateDieArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand(
      "die", "Angles and, where something supports them, lengths of a die from scans around it");
  app->add_option("SCANS", a.scans, "Two or more scans of the die, best four around it")
      ->required()
      ->expected(2, 1000);
  app->add_option("--edge", a.edge_m, "Nominal edge of the die (m), to find it")->required();
  app->add_option("--edge-sd", a.edge_sd_m,
                  "Every edge has the length --edge within this standard deviation (m), e.g. by "
                  "caliper; without it --edge says nothing about the lengths")
      ->check(CLI::PositiveNumber);
  app->add_option("--out", a.out, "DIE.json for `register die --die`")->required();
  app->add_flag("--without-planes", a.without_planes,
                "Do not use planes of the scene that scans share with the first one");
  app->add_flag(
      "--extents", a.extents,
      "Take lengths from the facets' extents (millimetres; where --edge-sd is not given)");
  app->add_option("--chirality", a.chirality,
                  "How 1, 2, 3 run about their corner, seen from outside")
      ->check(CLI::IsMember({"clockwise", "counterclockwise", "any"}))
      ->capture_default_str();
  app->add_option("--noise", a.noise_file, "Noise model (JSON) behind the covariance");
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
