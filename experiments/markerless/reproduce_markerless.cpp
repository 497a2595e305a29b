#include "experiments/markerless/reproduce_markerless.hpp"

#include <algorithm>
#include <filesystem>

#include "alea/io/atomic_file.hpp"
#include "experiments/engine/folder.hpp"
#include "experiments/markerless/audit.hpp"
#include "experiments/markerless/success.hpp"
#include "experiments/markerless/twin_pictures.hpp"
#include "experiments/markerless/twin_tables.hpp"

namespace alea::experiments::markerless {
namespace {

/// One building: its scans, the paper's trials, and what the robust method makes of the same pairs.
struct Study {
  std::string name;
  TwinScans scans;
  std::vector<PaperTrial> trials;
  std::vector<JudgedPose> poses;
  int right = 0, refused = 0, wrong = 0;
};

void run_robust(Study& study, std::size_t reference, const ReproductionOptions& options) {
  std::vector<PreparedScan> prepared;
  for (const Cloud& cloud : study.scans.clouds) prepared.push_back(prepare_scan(cloud, {}));
  MarkerlessOptions markerless;
  markerless.seed = options.seed;
  for (std::size_t other = 0; other < prepared.size(); ++other) {
    if (other == reference) continue;
    const MarkerlessRegistration found =
        register_prepared(prepared[reference], prepared[other], markerless);
    const RigidTransform truth = study.scans.truth(reference, other);
    const auto& estimate = found.registration.master_from_slave;
    if (!estimate)
      ++study.refused;
    else
      ++(pose_error(*estimate, truth).is_right() ? study.right : study.wrong);
    std::vector<RigidTransform> poses;
    if (estimate) poses.push_back(*estimate);
    for (const MarkerlessAlternative& alternative : found.report.alternatives)
      if (poses.size() < 5) poses.push_back(alternative.fixed_from_moving);
    for (const PaperTrial& trial : study.trials)
      if (trial.fixed == study.scans.names[reference] && trial.moving == study.scans.names[other])
        poses.push_back(trial.estimate);
    const auto judged = judged_poses(prepared[reference], prepared[other], poses, truth);
    study.poses.insert(study.poses.end(), judged.begin(), judged.end());
    if (options.progress) options.progress("robust pairs", other + 1, prepared.size());
  }
}

Study run_study(const std::string& name, const Scene& scene, std::size_t reference,
                const ReproductionOptions& options) {
  Study study;
  study.name = name;
  const std::vector<std::size_t> few =
      name == "bell tower" ? std::vector<std::size_t>{0, 1, 5} : std::vector<std::size_t>{1, 3, 5};
  study.scans = scan_twin(scene, options.smoke ? few : std::vector<std::size_t>{}, options.seed);
  if (options.smoke) reference = name == "bell tower" ? 0 : 2;
  study.trials = run_paper(study.scans, reference, {}, options.progress);
  run_robust(study, reference, options);
  return study;
}

ResultTable robust_table(const std::vector<Study>& studies) {
  ResultTable table{"robust",
                    "The robust method on the same pairs",
                    "Right: within 1 deg and 0.1 m of the truth; refused pairs are not wrong.",
                    {}};
  for (const Study& study : studies) {
    const auto add = [&](const char* column, int count) {
      const auto value = static_cast<double>(count);
      table.cells.push_back(
          {study.name, column, "pairs", "", Interval{value, value, value}, Verdict::ours, ""});
    };
    add("right", study.right);
    add("refused", study.refused);
    add("wrong", study.wrong);
  }
  return table;
}

void draw(const Study& study, const std::string& stem, const std::string& out) {
  draw_station_plan(study.scans, "stations of the " + study.name + "'s twin", out, stem + "_plan");
  const auto by_rmse = [](const PaperTrial& a, const PaperTrial& b) { return a.rmse_m < b.rmse_m; };
  draw_overlays(study.scans, *std::min_element(study.trials.begin(), study.trials.end(), by_rmse),
                out, stem + "_lowest_rmse");
  draw_overlays(study.scans, *std::max_element(study.trials.begin(), study.trials.end(), by_rmse),
                out, stem + "_highest_rmse");
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
  std::vector<JudgedPose> poses;
  for (const Study& study : studies)
    poses.insert(poses.end(), study.poses.begin(), study.poses.end());
  const std::vector<ResultTable> tables{
      audit_published(published),
      twin_table1(published, studies[0].scans),
      twin_table2(published, studies[0].scans),
      twin_pairs_table("table3", "Table 3 on the bell tower's twin", published.bell_tower,
                       published.tower_averages, studies[0].trials),
      twin_pairs_table("table4", "Table 4 on the lighthouse's twin", published.lighthouse,
                       published.lighthouse_averages, studies[1].trials),
      robust_table(studies),
      success_table(poses)};
  for (const ResultTable& table : tables) write_table(options.out, table);
  draw(studies[0], "bell_tower", options.out);
  draw(studies[1], "lighthouse", options.out);
  return tables;
}

}  // namespace alea::experiments::markerless
