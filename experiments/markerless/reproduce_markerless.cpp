#include "experiments/markerless/reproduce_markerless.hpp"

#include <algorithm>
#include <filesystem>

#include "alea/io/atomic_file.hpp"
#include "experiments/engine/folder.hpp"
#include "experiments/markerless/audit.hpp"
#include "experiments/markerless/grid_study.hpp"
#include "experiments/markerless/keypoint_table.hpp"
#include "experiments/markerless/success.hpp"
#include "experiments/markerless/twin_pictures.hpp"
#include "experiments/markerless/twin_tables.hpp"

namespace alea::experiments::markerless {
namespace {

/// One building: its scans, the paper's trials of the printed pairs, the robust method's of every
/// pair, and every pose of both with what speaks for it.
struct Study {
  std::string name;
  TwinScans scans;
  std::vector<ScanPair> printed;  ///< the reference with every other, and back
  std::vector<PaperTrial> trials;
  std::vector<RobustTrial> robust;
  std::vector<JudgedPose> poses;
};

Study run_study(const std::string& name, const Scene& scene, std::size_t reference,
                const ReproductionOptions& options) {
  Study study;
  study.name = name;
  const std::vector<std::size_t> few =
      name == "bell tower" ? std::vector<std::size_t>{0, 1, 5} : std::vector<std::size_t>{1, 3, 5};
  study.scans = scan_twin(scene, options.smoke ? few : std::vector<std::size_t>{}, options.seed);
  if (options.smoke) reference = name == "bell tower" ? 0 : 2;
  const std::size_t scans = study.scans.clouds.size();
  study.printed = reference_pairs(scans, reference);
  study.trials = run_paper(study.scans, study.printed, {}, options.progress);
  const std::vector<PreparedScan> prepared = prepare_scans(study.scans);
  study.robust =
      run_robust(study.scans, prepared, all_pairs(scans), options.seed, options.progress);
  study.poses = judged_poses(name, study.scans, prepared, study.robust, study.trials);
  return study;
}

ResultTable robust_table(const std::vector<Study>& studies) {
  ResultTable table{"robust",
                    "The robust method on every pair of the twins",
                    "Right: within 1 deg and 0.1 m of the truth; refused pairs are not wrong.",
                    {}};
  for (const Study& study : studies) add_robust_cells(study.name, study.robust, table);
  return table;
}

ResultTable keypoints_of(const std::vector<Study>& studies, const ReproductionOptions& options) {
  ResultTable table = keypoint_table();
  for (const Study& study : studies)
    add_keypoint_cells(study.name, study.scans, study.printed, study.trials, table,
                       options.progress);
  return table;
}

std::vector<GridTrial> grids_of(const Study& tower, const ReproductionOptions& options) {
  GridStudyOptions grids;
  grids.seed = options.seed;
  if (options.smoke) {
    grids.cells_m = {0.025, 0.05, 0.1};
    grids.robust_cells_m = {0.1};
    grids.draws = 2;
  }
  return run_grids(tower.scans, grids, options.progress);
}

void draw(const Study& study, const std::string& stem, const std::string& out) {
  draw_station_plan(study.scans, "stations of the " + study.name + "'s twin", out, stem + "_plan");
  const auto extreme = [&](double PaperTrial::*figure, const char* low, const char* high) {
    const auto less = [&](const PaperTrial& a, const PaperTrial& b) {
      return a.*figure < b.*figure;
    };
    const auto [least, most] = std::minmax_element(study.trials.begin(), study.trials.end(), less);
    draw_overlays(study.scans, *least, out, stem + low);
    draw_overlays(study.scans, *most, out, stem + high);
  };
  extreme(&PaperTrial::rmse_m, "_lowest_rmse", "_highest_rmse");
  extreme(&PaperTrial::overlap, "_smallest_overlap", "_largest_overlap");
  write_file_atomically((std::filesystem::path(out) / (stem + "_pairs.csv")).string(),
                        trials_csv(study.trials));
}

}  // namespace

std::vector<ResultTable> reproduce_markerless(const ReproductionOptions& options) {
  make_folder(options.out);
  const PublishedTables published = load_published_tables();
  TwinOptions twin;
  twin.layout = options.seed;
  twin.step_rad = options.smoke ? 10e-3 : 2.7e-3;
  const std::vector<Study> studies{run_study("bell tower", bell_tower(twin), 0, options),
                                   run_study("lighthouse", lighthouse(twin), 5, options)};
  const Study &tower = studies[0], &lights = studies[1];
  std::vector<JudgedPose> poses = tower.poses;
  poses.insert(poses.end(), lights.poses.begin(), lights.poses.end());
  const std::vector<GridTrial> grids = grids_of(tower, options);
  const std::vector<ResultTable> tables{
      audit_published(published),
      twin_table1(published, tower.scans),
      twin_table2(published, tower.scans),
      twin_pairs_table("table3", "Table 3 on the bell tower's twin", published.bell_tower,
                       published.tower_averages, tower.trials),
      twin_pairs_table("table4", "Table 4 on the lighthouse's twin", published.lighthouse,
                       published.lighthouse_averages, lights.trials),
      grid_table(grids),
      keypoints_of(studies, options),
      robust_table(studies),
      success_table(poses, options.seed)};
  for (const ResultTable& table : tables) write_table(options.out, table);
  write_file_atomically((std::filesystem::path(options.out) / "poses.csv").string(),
                        poses_csv(poses));
  draw(tower, "bell_tower", options.out);
  draw(lights, "lighthouse", options.out);
  draw_keypoints(tower.scans, 0, options.out, "figure2");
  draw_grids(grids, options.out, "grids");
  draw_roc(poses, options.out, "roc");
  return tables;
}

}  // namespace alea::experiments::markerless
