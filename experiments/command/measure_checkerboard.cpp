#include "alea/pipeline/measure_checkerboard.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/version.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/stopwatch.hpp"
#include "alea/report/board_page.hpp"
#include "experiments/command/json_parts.hpp"
#include "experiments/command/measure.hpp"
#include "experiments/command/reading.hpp"

namespace alea::command {
namespace {

struct MeasureArguments {
  CommonOptions common;
  std::string cloud, near, method = "likelihood", report;
  BoardArguments board;
  bool no_outliers = false, no_otsu = false, no_plane = false, no_colour = false,
       not_centred = false, ablation = false;
  ReadingOptions reading;
};

MeasureCheckerboardOptions options_of(const MeasureArguments& arguments) {
  MeasureCheckerboardOptions options;
  options.target = board_options(arguments.board);
  if (!arguments.near.empty()) {
    const auto at = parse_point("--near", arguments.near);
    options.near_m = Eigen::Vector3d((*at)[0], (*at)[1], (*at)[2]);
  }
  options.method =
      arguments.method == "coloured_icp" ? BoardMethod::coloured_icp : BoardMethod::likelihood;
  options.coloured.remove_outliers = !arguments.no_outliers;
  options.coloured.binarise = !arguments.no_otsu;
  options.coloured.point_to_plane = !arguments.no_plane;
  options.coloured.coloured = !arguments.no_colour;
  options.coloured.centred = !arguments.not_centred;
  if ((arguments.ablation || !arguments.report.empty()) && !options.near_m)
    throw usage_error("--ablation and --report need --near X,Y,Z");
  return options;
}

void print(const BoardMeasurement& m) {
  fmt::print("centre            ({:.5f}, {:.5f}, {:.5f}) m\n", m.centre_m.x(), m.centre_m.y(),
             m.centre_m.z());
  if (m.covariance) {
    const Eigen::Vector3d sd = m.covariance->diagonal().cwiseSqrt() * 1e3;
    fmt::print("standard dev.     ({:.3f}, {:.3f}, {:.3f}) mm\n", sd.x(), sd.y(), sd.z());
  }
  if (m.bound)
    fmt::print("bound             {:.3f} mm (root of the trace; here {:.3f})\n",
               1e3 * std::sqrt(m.bound->trace()), 1e3 * std::sqrt(m.covariance->trace()));
  fmt::print("normal            ({:.5f}, {:.5f}, {:.5f})\n", m.normal.x(), m.normal.y(),
             m.normal.z());
  fmt::print("cell              {:.5f} m{}\n", m.cell_m, m.cell_estimated ? "" : " (as given)");
  fmt::print("rmse              {:.2f} mm along the normal, {} points\n", 1e3 * m.rmse_m, m.points);
  fmt::print("colour score      {:.3f}\n", m.colour_score);
  for (const std::string& warning : m.warnings) fmt::print("warning           {}\n", warning);
}

nlohmann::json document(const Result<std::vector<BoardMeasurement>>& result, bool with_targets,
                        const MeasureArguments& arguments, double read_s, double measure_s) {
  nlohmann::json out{
      {"alea", version()},
      {"status", result ? "measured" : "refused"},
      {"refusal", nullptr},
      {"method", arguments.method},
      {"warnings", nlohmann::json::array()},
      {"timing_s", {{"read", read_s}, {"measure", measure_s}, {"total", read_s + measure_s}}}};
  if (!result) {
    out["refusal"] = refusal_json(result.refusal());
    for (const char* key :
         {"centre_m", "covariance", "normal", "axes", "cell_m", "rmse_m", "colour_score", "bound"})
      out[key] = nullptr;
    if (with_targets) out["targets"] = nlohmann::json::array();
    return out;
  }
  out.update(measurement_json(result->front()));
  out["warnings"] = result->front().warnings;
  if (!with_targets) return out;
  out["targets"] = nlohmann::json::array();
  for (const BoardMeasurement& one : *result) out["targets"].push_back(measurement_json(one));
  return out;
}

/// Every combination that leaves one step out, against the likelihood's centre.
nlohmann::json ablation(const Cloud& cloud, const MeasureCheckerboardOptions& options) {
  const auto reference = measure_by_likelihood(cloud, *options.near_m, options.target);
  nlohmann::json rows = nlohmann::json::array();
  const auto add = [&](const char* name, auto change) {
    ColouredBoardOptions coloured;
    change(coloured);
    const auto one = measure_by_coloured_icp(cloud, *options.near_m, options.target, coloured);
    nlohmann::json row{{"steps", name}, {"status", one ? "measured" : "refused"}};
    if (one) {
      row["colour_score"] = one->colour_score;
      row["rmse_m"] = one->rmse_m;
      if (reference) row["from_likelihood_m"] = (one->centre_m - reference->centre_m).norm();
    }
    rows.push_back(row);
  };
  add("all", [](ColouredBoardOptions&) {});
  add("without outlier removal", [](ColouredBoardOptions& o) { o.remove_outliers = false; });
  add("without Otsu", [](ColouredBoardOptions& o) { o.binarise = false; });
  add("without both", [](ColouredBoardOptions& o) { o.remove_outliers = o.binarise = false; });
  add("without point-to-plane", [](ColouredBoardOptions& o) { o.point_to_plane = false; });
  add("without coloured ICP", [](ColouredBoardOptions& o) { o.coloured = false; });
  add("not centred", [](ColouredBoardOptions& o) { o.centred = false; });
  return rows;
}

int run(const MeasureArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const MeasureCheckerboardOptions options = options_of(arguments);
  Stopwatch watch;
  Cloud cloud = read_cloud(arguments.cloud, read_options(arguments.reading));
  if (cloud.empty())
    throw input_error(fmt::format("{}: no points; a scan is needed", arguments.cloud));
  if (!cloud.has_intensity() && cloud.colours.empty())
    throw input_error(fmt::format(
        "{}: no intensity and no colour; a checkerboard cannot be read from it", arguments.cloud));
  cloud = with_intensity(std::move(cloud));
  const double read_s = watch.lap_s();
  const auto result = measure_checkerboard(cloud, options);
  const double measure_s = watch.lap_s();
  nlohmann::json out = document(result, !options.near_m, arguments, read_s, measure_s);
  if (arguments.ablation) out["ablation"] = ablation(cloud, options);
  write_json(arguments.common, out);
  if (!arguments.report.empty())
    write_page(arguments.report, board_page(cloud, *options.near_m, options));
  if (!result) return report_refusal(result.refusal());
  if (arguments.common.json == "-") return exit_done;
  for (const BoardMeasurement& one : *result) print(one);
  if (arguments.ablation)
    for (const auto& row : out["ablation"]) fmt::print("{}\n", row.dump());
  return exit_done;
}

}  // namespace

void add_measure_checkerboard(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<MeasureArguments>();
  MeasureArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand(
      "checkerboard", "Centre of a checkerboard target (m), or of all of one size in a scan");
  app->add_option("CLOUD", a.cloud, "Scan with intensity or colour")->required();
  add_board_options(*app, a.board);
  app->add_option(
      "--near", a.near,
      "Where the centre is to one side: X,Y,Z (m); as --near=X,Y,Z where X is negative. "
      "Without it: every target of this size");
  app->add_option(
         "--method", a.method,
         "likelihood: robust plane and blurred edges; coloured_icp: the published pipeline")
      ->check(CLI::IsMember({"likelihood", "coloured_icp"}))
      ->capture_default_str();
  app->add_option("--origin", a.board.origin, "Scanner position in the scan's frame: X,Y,Z (m)");
  app->add_flag("--no-outlier-removal", a.no_outliers, "coloured_icp: keep points off the plane");
  app->add_flag("--no-otsu", a.no_otsu, "coloured_icp: keep intensities as they are");
  app->add_flag("--no-point-to-plane", a.no_plane, "coloured_icp: without the first alignment");
  app->add_flag("--no-coloured", a.no_colour, "coloured_icp: without the last alignment");
  app->add_flag("--not-centred", a.not_centred, "coloured_icp: in the scan's own frame and metres");
  app->add_flag("--ablation", a.ablation, "The published pipeline with each step left out in turn");
  app->add_option("--report", a.report, "Folder for a page with a picture of every stage");
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
