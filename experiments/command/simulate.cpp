#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/simulate/scanner.hpp"
#include "alea/simulate/scene_file.hpp"
#include "alea/simulate/truth.hpp"
#include "experiments/command/command.hpp"
#include "experiments/engine/folder.hpp"

namespace alea::command {
namespace {

struct Simulate {
  std::string scene;
  std::string out;
  CommonOptions common;
};

int run(const Simulate& simulate) {
  const ThreadLimit limit(simulate.common.threads);
  const Scene scene = load_scene(simulate.scene);
  const std::filesystem::path folder(simulate.out);
  experiments::make_folder(folder);
  const ProgressCallback progress = make_progress(simulate.common);
  std::vector<WrittenScan> scans;
  for (std::uint32_t i = 0; i < scene.stations.size(); ++i) {
    const Station& station = scene.stations[i];
    const Cloud cloud = simulate_scan(scene, station, {simulate.common.seed, 0, 0, i}, progress);
    scans.push_back({station.name + ".ply", cloud.size()});
    write_cloud((folder / scans.back().file).string(), cloud);
  }
  const std::string truth = truth_json(scene, simulate.common.seed, scans);
  write_file_atomically(folder / "truth.json", truth);
  write_json(simulate.common, nlohmann::json::parse(truth));
  return exit_done;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto simulate = std::make_shared<Simulate>();
  CLI::App* sub = app.add_subcommand(
      "simulate", "Scans a scene: one PLY for each station and truth.json, metres and radians");
  sub->add_option("scene", simulate->scene, "Scene file (TOML, lengths in metres)")->required();
  sub->add_option("--out", simulate->out, "Folder for the scans; made if missing")->required();
  add_common_options(*sub, simulate->common);
  sub->callback([simulate, &exit_code] { exit_code = run(*simulate); });
}

}  // namespace alea::command
