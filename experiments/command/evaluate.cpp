#include <fmt/format.h>

#include <array>
#include <memory>

#include "alea/cloud/canonical_order.hpp"
#include "alea/cloud/spacing.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/evaluate/check_planes.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct EvaluateArguments {
  CommonOptions common;
  std::string master, slave, transform;
  std::string planes = "cells";
  ReadingOptions reading;
};

struct ScanPlanes {
  Cloud cloud;
  std::vector<PlaneRegion> regions;
};

ScanPlanes read_planes(const std::string& path, const EvaluateArguments& arguments) {
  ScanPlanes out;
  out.cloud = canonical_order(read_cloud(path, read_options(arguments.reading)));
  if (out.cloud.size() < 3)
    throw input_error(fmt::format("{}: fewer than three points; a scan is needed", path));
  out.regions = detect_planes(out.cloud, {.detector = plane_detector_from_name(arguments.planes),
                                          .seed = arguments.common.seed});
  return out;
}

int run(const EvaluateArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  Registration result;
  result.method = "given";
  result.master_from_slave = read_transform(arguments.transform);
  std::array<ScanPlanes, 2> scans;
  parallel_pair([&] { scans[0] = read_planes(arguments.master, arguments); },
                [&] { scans[1] = read_planes(arguments.slave, arguments); });
  const auto& [master, slave] = scans;
  for (const CommonPlane& pair : find_common_planes(master.cloud, master.regions, slave.cloud,
                                                    slave.regions, *result.master_from_slave))
    result.check_planes.push_back(
        evaluate_check_plane(master.cloud, slave.cloud, pair, *result.master_from_slave));
  const double reach_m = 3 * std::max(median_spacing_m(master.cloud).value_or(0),
                                      median_spacing_m(slave.cloud).value_or(0));
  const double overlap_master =
      overlap_share(master.cloud, slave.cloud, result.master_from_slave->inverse(), reach_m);
  const double overlap_slave =
      overlap_share(slave.cloud, master.cloud, *result.master_from_slave, reach_m);

  nlohmann::json planes = nlohmann::json::array();
  for (const CheckPlane& plane : result.check_planes) planes.push_back(check_plane_json(plane));
  write_json(arguments.common, {{"check_planes", planes},
                                {"overlap_master", overlap_master},
                                {"overlap_slave", overlap_slave}});
  if (arguments.common.json == "-") return exit_done;
  print_check_planes(result.check_planes);
  fmt::print("overlap (share of points within {:.1f} mm): master {:.3f}, slave {:.3f}\n",
             reach_m * 1e3, overlap_master, overlap_slave);
  return exit_done;
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command =
      app.add_subcommand("evaluate", "Check planes and overlap of two scans under any transform");
  command->add_option("MASTER", arguments->master, "Master scan")->required();
  command->add_option("SLAVE", arguments->slave, "Slave scan")->required();
  command
      ->add_option(
          "--transform", arguments->transform,
          "master_from_slave: 16 numbers row by row (metres), or a JSON of `alea register`")
      ->required();
  command->add_option("--planes", arguments->planes, "Plane detector")
      ->check(CLI::IsMember({"cells", "efficient_ransac", "region_growing", "ndt_ransac"}))
      ->capture_default_str();
  add_reading_options(*command, arguments->reading);
  add_common_options(*command, arguments->common);
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
