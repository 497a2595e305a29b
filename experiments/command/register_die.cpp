#include "alea/pipeline/register_die.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <sstream>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/die_stages.hpp"
#include "alea/report/die_page.hpp"
#include "experiments/command/centroid_file.hpp"
#include "experiments/command/control_file.hpp"
#include "experiments/command/die_file.hpp"
#include "experiments/command/noise_file.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/register.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct DieArguments {
  CommonOptions common;
  std::vector<std::string> scans;
  double edge_m = 0;
  std::vector<double> edges_m;
  double edge_sd_m = 0;
  std::string shape_file;
  std::string method = "adjustment";
  std::string planes;
  std::string refine = "none";
  bool calibrate = false;
  std::string chirality = "clockwise";
  double tilt_prior_deg = 0, level_sd_arcsec = 0;
  bool join_planes = false, levelled = false;
  std::string resolve = "none", weights = "noise";
  std::string near, master_origin, slave_origin;
  std::string check_planes_file, noise_file;
  std::string report_folder;
  ControlOptions control;
  ReadingOptions reading;
};

const std::map<std::string, DieMethod> methods{{"paper", DieMethod::paper},
                                               {"paper_literal", DieMethod::paper_literal},
                                               {"closed_form", DieMethod::closed_form},
                                               {"adjustment", DieMethod::adjustment}};
const std::map<std::string, Refinement> refinements{
    {"none", Refinement::none}, {"planes", Refinement::planes}, {"icp", Refinement::icp}};
const std::map<std::string, FacetWeights> facet_weights{
    {"noise", FacetWeights::noise}, {"area", FacetWeights::area}, {"robust", FacetWeights::robust}};
constexpr double smallest_edge_m = 0.02, largest_edge_m = 10;

void check_edge(double edge_m, const char* option) {
  if (!(edge_m >= smallest_edge_m && edge_m <= largest_edge_m))
    throw usage_error(fmt::format("{}: {} m is not the edge of a die; give metres from {} to {}",
                                  option, edge_m, smallest_edge_m, largest_edge_m));
}

std::optional<Eigen::Vector3d> point(const std::string& option, const std::string& text) {
  const auto parsed = parse_point(option, text);
  return parsed ? std::optional<Eigen::Vector3d>(
                      Eigen::Vector3d((*parsed)[0], (*parsed)[1], (*parsed)[2]))
                : std::nullopt;
}

DieRegistrationOptions registration_options(const DieArguments& arguments) {
  DieRegistrationOptions options;
  if (arguments.edge_m != 0) check_edge(arguments.edge_m, "--edge");
  options.edge_m = arguments.edge_m;
  if (!arguments.edges_m.empty()) {
    for (const double edge_m : arguments.edges_m) check_edge(edge_m, "--edges");
    options.edges_m = {arguments.edges_m[0], arguments.edges_m[1], arguments.edges_m[2]};
  }
  if (arguments.edge_sd_m < 0)
    throw usage_error("--edge-sd: a standard deviation is not negative; give metres");
  if (arguments.edge_sd_m > 0) options.edge_sd_m = arguments.edge_sd_m;
  if (!arguments.shape_file.empty()) {
    GivenShape given =
        read_die_file(arguments.shape_file, arguments.edge_m > 0 ? arguments.edge_m / 2 : 0.25);
    options.shape = given.shape;
    options.shape_covariance = given.covariance;
  }
  if (options.edge_m == 0 && !options.edges_m && !options.shape)
    throw usage_error(
        "the die's size is not known; give --edge METRES, --edges A,B,C or --die DIE.json");
  options.method = methods.at(arguments.method);
  // The published chain includes its own detector.
  const bool published = is_published(options.method);
  options.planes = plane_detector_from_name(!arguments.planes.empty() ? arguments.planes
                                            : published               ? "ndt_ransac"
                                                                      : "cells");
  options.calibrate = arguments.calibrate;
  if (arguments.chirality == "any")
    options.chirality = std::nullopt;
  else
    options.chirality =
        arguments.chirality == "clockwise" ? Chirality::clockwise : Chirality::counterclockwise;
  if (arguments.tilt_prior_deg > 0)
    options.tilt_prior_rad = arguments.tilt_prior_deg * std::numbers::pi / 180;
  if (arguments.level_sd_arcsec > 0)
    options.level_sd_rad = arguments.level_sd_arcsec * std::numbers::pi / 180 / 3600;
  options.join_planes = arguments.join_planes;
  options.levelled = arguments.levelled;
  options.weights = facet_weights.at(arguments.weights);
  options.resolve_by_scene = arguments.resolve == "scene";
  options.near_m = point("--near", arguments.near);
  if (!arguments.check_planes_file.empty())
    options.check_plane_centroids_m = read_centroid_file(arguments.check_planes_file);
  options.refine = refinements.at(arguments.refine);
  if (!arguments.noise_file.empty()) options.noise = read_noise_file(arguments.noise_file);
  options.seed = arguments.common.seed;
  return options;
}

Cloud read_scan(const std::string& path, const ReadOptions& read,
                const std::optional<Eigen::Vector3d>& origin) {
  Cloud cloud = read_cloud(path, read);
  if (origin) cloud.scanner_position = origin;
  if (cloud.empty()) throw input_error(fmt::format("{}: no points; a scan is needed", path));
  if (!cloud.has_intensity())
    throw input_error(fmt::format(
        "{}: no intensity, so the pips cannot be read; export the scan with intensity", path));
  return cloud;
}

/// The folder itself for one slave; one folder in it for each of several.
std::filesystem::path report_folder(const DieArguments& arguments, std::size_t scan) {
  const std::filesystem::path folder = arguments.report_folder;
  return arguments.scans.size() == 2 ? folder : folder / fmt::format("slave_{}", scan);
}

int run(const DieArguments& arguments) {
  const DieRegistrationOptions options = registration_options(arguments);
  if (!arguments.control.control_file.empty() && arguments.control.targets_file.empty())
    throw usage_error(
        "--control: also give --targets FILE, the same points in the master's frame (name x y z)");
  const auto master_origin = point("--master-origin", arguments.master_origin);
  const auto slave_origin = point("--slave-origin", arguments.slave_origin);
  const ThreadLimit limit(arguments.common.threads);
  const auto start = std::chrono::steady_clock::now();
  std::vector<Cloud> clouds(arguments.scans.size());
  parallel_chunks(clouds.size(), 1, [&](std::size_t i, std::size_t) {
    clouds[i] = read_scan(arguments.scans[i], read_options(arguments.reading),
                          i == 0 ? master_origin : slave_origin);
  });
  const double read_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const std::span<const Cloud> slaves(clouds.data() + 1, clouds.size() - 1);
  std::vector<Registration> results;
  if (arguments.report_folder.empty()) {
    results = register_die(clouds[0], slaves, options);
  } else {
    for (StagedDieRegistration& staged : register_die_in_stages(clouds[0], slaves, options)) {
      const std::size_t scan = results.size() + 1;
      write_page(report_folder(arguments, scan),
                 die_page(staged, arguments.scans[0], arguments.scans[scan]));
      results.push_back(std::move(staged.registration));
    }
  }
  for (Registration& result : results) {
    result.timing_s.insert(result.timing_s.begin(), {"read", read_s});
    result.timing_s.back().second += read_s;
  }
  tie_to_control(arguments.control, {}, results);
  return finish_registrations(arguments.common, results);
}

/// What is known of the die.
void add_die_options(CLI::App& app, DieArguments& a) {
  app.add_option("--edge", a.edge_m,
                 "Length of the die's shared edge, corner to corner (m, 0.02 to 10)");
  app.add_option("--edges", a.edges_m, "Three edge lengths of a cuboid (m), as A,B,C")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--edge-sd", a.edge_sd_m,
                 "Standard deviation of --edge (m); without it --edge is exact");
  app.add_option("--die", a.shape_file,
                 "Calibrated shape (DIE.json, or the truth.json of simulate)");
  app.add_flag("--calibrate", a.calibrate,
               "Estimate the edge length on planes that both scans see");
  app.add_option("--chirality", a.chirality,
                 "How 1, 2, 3 run about their corner, seen from outside")
      ->check(CLI::IsMember({"clockwise", "counterclockwise", "any"}))
      ->capture_default_str();
  app.add_option("--facet-weights", a.weights,
                 "Weights of a facet's points: noise (its model), area (for warped facets), robust "
                 "(strays count less); not for the paper's methods")
      ->check(CLI::IsMember({"noise", "area", "robust"}))
      ->capture_default_str();
  app.add_option("--resolve", a.resolve,
                 "Where the pips leave several orientations, or there are none (a blank cube): "
                 "none refuses, scene asks the planes of the rest of both scans")
      ->check(CLI::IsMember({"none", "scene"}))
      ->capture_default_str();
  app.add_flag("--levelled", a.levelled,
               "Both scanners stand level: only orientations that keep the vertical are possible "
               "(4 of 24)");
  app.add_option("--near", a.near, "Where the die is, roughly, in the master frame: X,Y,Z (m)");
}

}  // namespace

void add_register_die(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<DieArguments>();
  CLI::App* app = parent.add_subcommand("die", "Register scans by one die that all of them see");
  DieArguments& a = *arguments;
  app->add_option("SCANS", a.scans,
                  "Master scan, then one or more slave scans (PLY, PCD, XYZ, PTS, PTX, E57, LAS)")
      ->required()
      ->expected(2, 1000);
  add_die_options(*app, a);
  app->add_option(
         "--method", a.method,
         "adjustment: all scans in one least squares; closed_form: shared edge and facets, "
         "slave by slave; paper: the published chain, corrected; paper_literal: as printed")
      ->check(CLI::IsMember({"paper", "paper_literal", "closed_form", "adjustment"}))
      ->capture_default_str();
  app->add_option("--planes", a.planes,
                  "Plane detector (default: cells; ndt_ransac for the paper's methods)")
      ->check(CLI::IsMember({"cells", "efficient_ransac", "region_growing", "ndt_ransac"}));
  app->add_option("--refine", a.refine,
                  "Fine registration after the die on half of the planes that both scans see "
                  "(never the check planes): planes, or point-to-plane icp on their points")
      ->check(CLI::IsMember({"none", "planes", "icp"}))
      ->capture_default_str();
  app->add_option("--tilt-prior-deg", a.tilt_prior_deg,
                  "Standard deviation of the facets' tilts (deg), where only one "
                  "facet is shared")
      ->check(CLI::PositiveNumber);
  app->add_option("--level-sd-arcsec", a.level_sd_arcsec,
                  "Levelled scanners: standard deviation of their z axes from the vertical (arc "
                  "seconds; adjustment only)")
      ->check(CLI::PositiveNumber);
  app->add_flag(
      "--join-planes", a.join_planes,
      "Planes that both scans see take part in the adjustment; every second one, or those "
      "that --check-planes does not name");
  app->add_option("--master-origin", a.master_origin,
                  "Scanner position in the master's frame: X,Y,Z (m)");
  app->add_option("--slave-origin", a.slave_origin,
                  "Scanner position in the slaves' frames: X,Y,Z (m)");
  app->add_option("--check-planes", a.check_planes_file,
                  "File of centroids (x y z, master frame, m) of the check "
                  "planes; the other common planes calibrate");
  app->add_option("--noise", a.noise_file, "Noise model (JSON) behind the covariance");
  app->add_option("--report", a.report_folder,
                  "Folder for a page with pictures of every stage (index.html, PNG), also of a "
                  "refusal; with several slaves one folder in it for each");
  add_control_options(*app, a.control);
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
