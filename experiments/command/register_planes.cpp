#include "alea/pipeline/register_planes.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/centroid_file.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/register.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct PlaneArguments {
  CommonOptions common;
  std::string master, slave, initial, check_planes_file;
  std::string planes = "cells";
  ReadingOptions reading;
};

Cloud read_scan(const std::string& path, const ReadingOptions& reading) {
  Cloud cloud = read_cloud(path, read_options(reading));
  if (cloud.size() < 3)
    throw input_error(fmt::format("{}: fewer than three points; a scan is needed", path));
  return cloud;
}

int run(const PlaneArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  PlaneRegistrationOptions options;
  options.planes = plane_detector_from_name(arguments.planes);
  options.seed = arguments.common.seed;
  if (!arguments.initial.empty()) options.initial = read_transform(arguments.initial);
  if (!arguments.check_planes_file.empty())
    options.check_plane_centroids_m = read_centroid_file(arguments.check_planes_file);
  const auto start = std::chrono::steady_clock::now();
  Cloud master, slave;
  parallel_pair([&] { master = read_scan(arguments.master, arguments.reading); },
                [&] { slave = read_scan(arguments.slave, arguments.reading); });
  const double read_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Registration result = register_planes(master, slave, options);
  result.timing_s.insert(result.timing_s.begin(), {"read", read_s});
  result.timing_s.back().second += read_s;
  return finish_registrations(arguments.common, {result});
}

}  // namespace

void add_register_planes(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<PlaneArguments>();
  PlaneArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand(
      "planes", "Register two scans by the planes that both see, without any target");
  app->add_option("MASTER", a.master, "Master scan (PLY, PCD, XYZ, PTS, PTX, E57, LAS)")
      ->required();
  app->add_option("SLAVE", a.slave, "Slave scan")->required();
  app->add_option("--initial", a.initial,
                  "Approximate master_from_slave, within 5 deg and 0.15 m: 16 numbers row by row "
                  "(metres), or a JSON of `alea register`; without it planes are matched by their "
                  "angles");
  app->add_option("--check-planes", a.check_planes_file,
                  "File of centroids (x y z, master frame, m) of planes to hold out as check "
                  "planes; without it all planes take part");
  app->add_option("--planes", a.planes, "Plane detector")
      ->check(CLI::IsMember({"cells", "efficient_ransac", "region_growing", "ndt_ransac"}))
      ->capture_default_str();
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
