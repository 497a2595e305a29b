#include "alea/pipeline/register_markerless.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/stopwatch.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/register.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct MarkerlessArguments {
  CommonOptions common;
  std::string fixed, moving;
  std::string method = "robust";
  std::string objective = "point_to_plane";
  std::string keypoints = "none";
  double keypoint_radius_m = 0.3;
  bool levelled = false;
  std::string initial;
  double grid_m = 0.05;
  std::string fixed_origin, moving_origin;
  ReadingOptions reading;
};

constexpr double smallest_grid_m = 0.001, largest_grid_m = 10;
constexpr double least_keypoint_radius_m = 0.01, most_keypoint_radius_m = 10;

void set_keypoints(const MarkerlessArguments& arguments, PaperIcpOptions& paper) {
  if (!(arguments.keypoint_radius_m >= least_keypoint_radius_m &&
        arguments.keypoint_radius_m <= most_keypoint_radius_m))
    throw usage_error(fmt::format("--keypoint-radius: {} m; give metres from {} to {}",
                                  arguments.keypoint_radius_m, least_keypoint_radius_m,
                                  most_keypoint_radius_m));
  if (arguments.keypoints != "none" && arguments.method != "paper")
    throw usage_error("--keypoints belongs to --method paper; the robust method finds its own");
  if (arguments.keypoints == "harris") paper.keypoints = PaperKeypoints::harris;
  if (arguments.keypoints == "iss") paper.keypoints = PaperKeypoints::iss;
  paper.keypoint_radius_m = arguments.keypoint_radius_m;
}

MarkerlessOptions registration_options(const MarkerlessArguments& arguments) {
  MarkerlessOptions options;
  options.method = arguments.method == "paper" ? MarkerlessMethod::paper : MarkerlessMethod::robust;
  options.levelled = arguments.levelled;
  options.seed = arguments.common.seed;
  options.paper.cell_m = arguments.grid_m;
  if (arguments.grid_m != 0 &&
      !(arguments.grid_m >= smallest_grid_m && arguments.grid_m <= largest_grid_m))
    throw usage_error(
        fmt::format("--grid: {} m is no grid for a scan; give metres from {} to {}, "
                    "or 0 for every point",
                    arguments.grid_m, smallest_grid_m, largest_grid_m));
  if (arguments.objective == "point_to_point")
    options.paper.objective = IcpObjective::point_to_point;
  set_keypoints(arguments, options.paper);
  if (!arguments.initial.empty()) options.initial = read_transform(arguments.initial);
  return options;
}

Cloud read_scan(const std::string& path, const std::string& option, const std::string& origin,
                const ReadOptions& options) {
  Cloud cloud = read_cloud(path, options);
  if (cloud.empty()) throw input_error(fmt::format("{}: no points; a scan is needed", path));
  if (const auto place = parse_point(option, origin))
    cloud.scanner_position = Eigen::Vector3d((*place)[0], (*place)[1], (*place)[2]);
  return cloud;
}

nlohmann::json pose_json(const RigidTransform& pose) {
  const Eigen::Matrix4d m = pose.matrix();
  nlohmann::json rows = nlohmann::json::array();
  for (int i = 0; i < 4; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2), m(i, 3)});
  return rows;
}

nlohmann::json report_json(const MarkerlessReport& report) {
  nlohmann::json alternatives = nlohmann::json::array();
  for (const MarkerlessAlternative& other : report.alternatives)
    alternatives.push_back({{"master_from_slave", pose_json(other.fixed_from_moving)},
                            {"overlap", other.overlap},
                            {"conflict_ratio", other.conflict_ratio},
                            {"source", other.source}});
  return {{"overlap_fixed", report.overlap_fixed},
          {"overlap_moving", report.overlap_moving},
          {"conflict_ratio", report.conflict_ratio},
          {"rmse_m", report.rmse_m},
          {"iterations", report.iterations},
          {"keypoints_fixed", report.keypoints_fixed},
          {"keypoints_moving", report.keypoints_moving},
          {"alternatives", alternatives}};
}

int run(const MarkerlessArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const MarkerlessOptions options = registration_options(arguments);
  const ReadOptions reading = read_options(arguments.reading);
  Stopwatch stopwatch;
  Cloud fixed, moving;
  parallel_pair(
      [&] {
        fixed = read_scan(arguments.fixed, "--fixed-origin", arguments.fixed_origin, reading);
      },
      [&] {
        moving = read_scan(arguments.moving, "--moving-origin", arguments.moving_origin, reading);
      });
  const double read_s = stopwatch.lap_s();
  MarkerlessRegistration result = register_markerless(fixed, moving, options);
  auto& timing = result.registration.timing_s;
  timing.insert(timing.begin(), {"read", read_s});
  timing.back().second += read_s;
  nlohmann::json document = registration_json(result.registration, arguments.common.seed);
  document["markerless"] = report_json(result.report);
  write_json(arguments.common, document);
  if (result.registration.refusal) return report_refusal(*result.registration.refusal);
  if (arguments.common.json != "-") {
    print_registration(result.registration);
    fmt::print(
        "overlap {:.1f} % of the fixed, {:.1f} % of the moving scan; conflict ratio {:.4f}; "
        "RMSE {:.4f} m\n",
        100 * result.report.overlap_fixed, 100 * result.report.overlap_moving,
        result.report.conflict_ratio, result.report.rmse_m);
  }
  return exit_done;
}

}  // namespace

void add_register_markerless(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<MarkerlessArguments>();
  MarkerlessArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand("markerless",
                                        "Register two scans of the same place without any target");
  app->add_option("FIXED", a.fixed, "Fixed scan, the master (PLY, PCD, XYZ, PTS, PTX, E57, LAS)")
      ->required();
  app->add_option("MOVING", a.moving, "Moving scan, the slave")->required();
  app->add_option("--method", a.method,
                  "robust: candidates, refinement, free-space test; paper: grid average and ICP "
                  "from identity")
      ->check(CLI::IsMember({"paper", "robust"}))
      ->capture_default_str();
  app->add_flag("--levelled", a.levelled, "Both scanners' z axes are vertical within 0.5 deg");
  app->add_option("--initial", a.initial,
                  "Start: 16 numbers (master_from_slave, row by row) or a JSON of register");
  app->add_option("--grid", a.grid_m, "paper: grid average (m); 0 keeps every point")
      ->capture_default_str();
  app->add_option("--objective", a.objective, "paper: what ICP minimises")
      ->check(CLI::IsMember({"point_to_point", "point_to_plane"}))
      ->capture_default_str();
  app->add_option("--keypoints", a.keypoints,
                  "paper: ICP of these points of the grid alone, the step that the study describes "
                  "and its numbers do not contain")
      ->check(CLI::IsMember({"none", "harris", "iss"}))
      ->capture_default_str();
  app->add_option("--keypoint-radius", a.keypoint_radius_m,
                  "paper: neighbours of a keypoint's response (m)")
      ->capture_default_str();
  app->add_option("--fixed-origin", a.fixed_origin, "Scanner position in FIXED: X,Y,Z (m)");
  app->add_option("--moving-origin", a.moving_origin, "Scanner position in MOVING: X,Y,Z (m)");
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
