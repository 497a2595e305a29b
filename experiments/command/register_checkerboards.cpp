#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/measure_checkerboard.hpp"
#include "alea/pipeline/stopwatch.hpp"
#include "experiments/command/measure.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/register.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct BoardsArguments {
  CommonOptions common;
  std::string master, slave;
  BoardArguments board;
  ReadingOptions reading;
};

Cloud read_painted_scan(const std::string& path, const ReadOptions& options) {
  Cloud cloud = read_cloud(path, options);
  if (cloud.empty()) throw input_error(fmt::format("{}: no points; a scan is needed", path));
  if (!cloud.has_intensity() && cloud.colours.empty())
    throw input_error(fmt::format("{}: no intensity and no colour; checkerboards need one", path));
  return with_intensity(std::move(cloud));
}

nlohmann::json targets_json(const CheckerboardsRegistered& result) {
  nlohmann::json targets = nlohmann::json::array();
  for (std::size_t k = 0; k < result.pairs.size(); ++k)
    targets.push_back({{"master", measurement_json(result.master[result.pairs[k].first])},
                       {"slave", measurement_json(result.slave[result.pairs[k].second])},
                       {"residual_m", result.residual_m[k]}});
  return targets;
}

int run(const BoardsArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const BoardOptions target = board_options(arguments.board);
  const ReadOptions reading = read_options(arguments.reading);
  Stopwatch watch;
  Cloud master, slave;
  parallel_pair([&] { master = read_painted_scan(arguments.master, reading); },
                [&] { slave = read_painted_scan(arguments.slave, reading); });
  const double read_s = watch.lap_s();
  const auto result = register_checkerboards(master, slave, target);
  const double register_s = watch.lap_s();
  Registration registration;
  registration.method = "checkerboards";
  if (result) {
    registration.master_from_slave = result->master_from_slave;
    registration.covariance = result->covariance;
  } else {
    registration.refusal = result.refusal();
  }
  registration.timing_s = {
      {"read", read_s}, {"register", register_s}, {"total", read_s + register_s}};
  nlohmann::json document = registration_json(registration, arguments.common.seed);
  document["targets"] = result ? targets_json(*result) : nlohmann::json::array();
  write_json(arguments.common, document);
  if (!result) return report_refusal(result.refusal());
  if (arguments.common.json == "-") return exit_done;
  print_registration(registration);
  fmt::print("targets in both scans: {} (found: master {}, slave {})\n", result->pairs.size(),
             result->master.size(), result->slave.size());
  for (std::size_t k = 0; k < result->pairs.size(); ++k)
    fmt::print("  residual {:.2f} mm\n", result->residual_m[k] * 1e3);
  return exit_done;
}

}  // namespace

void add_register_checkerboards(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<BoardsArguments>();
  BoardsArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand(
      "checkerboards", "Register two scans by at least three checkerboards that both of them see");
  app->add_option("MASTER", a.master, "Master scan, with intensity or colour")->required();
  app->add_option("SLAVE", a.slave, "Slave scan")->required();
  add_board_options(*app, a.board);
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
