#include "alea/pipeline/register_network.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/version.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/pipeline/stopwatch.hpp"
#include "experiments/command/json_parts.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/register.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

struct NetworkArguments {
  CommonOptions common;
  std::vector<std::string> scans;
  bool levelled = false;
  ReadingOptions reading;
};

template <typename Matrix>
json rows_of(const Matrix& matrix) {
  json rows = json::array();
  for (int i = 0; i < matrix.rows(); ++i) {
    json row = json::array();
    for (int j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

json pair_json(const NetworkPair& pair) {
  json out{{"a", pair.a},
           {"b", pair.b},
           {"overlap", pair.overlap},
           {"status", pair.refusal    ? "refused"
                      : pair.accepted ? "accepted"
                                      : "rejected"},
           {"refusal", refusal_json(pair.refusal)},
           {"a_from_b", nullptr}};
  if (pair.edge) out["a_from_b"] = rows_of(pair.edge->a_from_b.matrix());
  return out;
}

json network_json(const NetworkArguments& arguments, const NetworkRegistration& network,
                  double read_s, double total_s) {
  json scans = json::array();
  for (std::size_t s = 0; s < network.master_from_scan.size(); ++s) {
    const TransformCovariance& c = network.covariance[s];
    scans.push_back({{"file", arguments.scans[s]},
                     {"master_from_scan", rows_of(network.master_from_scan[s].matrix())},
                     {"covariance", rows_of(c.covariance)},
                     {"covariance_about_m", {c.about_m.x(), c.about_m.y(), c.about_m.z()}}});
  }
  json pairs = json::array();
  for (const NetworkPair& pair : network.pairs) pairs.push_back(pair_json(pair));
  json out{{"alea", version()},
           {"status", network.refusal ? "refused" : "registered"},
           {"refusal", refusal_json(network.refusal)},
           {"method", "network"},
           {"seed", arguments.common.seed},
           {"warnings", json::array()},
           {"scans", scans},
           {"pairs", pairs},
           {"timing_s", {{"read", read_s}, {"total", total_s}}}};
  return out;
}

void print_network(const NetworkArguments& arguments, const NetworkRegistration& network) {
  for (std::size_t s = 0; s < network.master_from_scan.size(); ++s) {
    const Eigen::Vector3d& t = network.master_from_scan[s].translation;
    const Eigen::Vector3d turn =
        omega_phi_kappa_rad(network.master_from_scan[s].rotation) * 180 / 3.14159265358979323846;
    fmt::print("{}: position {:.4f} {:.4f} {:.4f} m, omega phi kappa {:.4f} {:.4f} {:.4f} deg\n",
               arguments.scans[s], t.x(), t.y(), t.z(), turn.x(), turn.y(), turn.z());
  }
  for (const NetworkPair& pair : network.pairs)
    if (pair.refusal || !pair.accepted)
      fmt::print("pair {} {}: {}\n", arguments.scans[pair.a], arguments.scans[pair.b],
                 pair.refusal ? pair.refusal->message : "rejected, it closes with no loop");
}

int run(const NetworkArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const ReadOptions reading = read_options(arguments.reading);
  NetworkOptions options;
  options.pair.levelled = arguments.levelled;
  options.pair.seed = arguments.common.seed;
  options.progress = make_progress(arguments.common);
  Stopwatch stopwatch;
  std::vector<Cloud> scans;
  for (const std::string& path : arguments.scans) {
    scans.push_back(read_cloud(path, reading));
    if (scans.back().empty())
      throw input_error(fmt::format("{}: no points; a scan is needed", path));
  }
  const double read_s = stopwatch.lap_s();
  const NetworkRegistration network = register_network(scans, options);
  write_json(arguments.common,
             network_json(arguments, network, read_s, read_s + stopwatch.lap_s()));
  if (network.refusal) return report_refusal(*network.refusal);
  if (arguments.common.json != "-") print_network(arguments, network);
  return exit_done;
}

}  // namespace

void add_register_network(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<NetworkArguments>();
  NetworkArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand(
      "network", "Register many scans of one place without any target, in the frame of the first");
  app->add_option("SCANS", a.scans, "Scans, the master first (PLY, PCD, XYZ, PTS, PTX, E57, LAS)")
      ->required()
      ->expected(2, 10000);
  app->add_flag("--levelled", a.levelled, "All scanners' z axes are vertical within 0.5 deg");
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
