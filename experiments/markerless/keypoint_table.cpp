#include "experiments/markerless/keypoint_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace alea::experiments::markerless {
namespace {

template <typename Figure>
std::vector<double> values_of(const std::vector<PaperTrial>& trials, Figure&& figure) {
  std::vector<double> values;
  for (const PaperTrial& trial : trials) values.push_back(static_cast<double>(figure(trial)));
  return values;
}

template <typename Holds>
double share_of(const std::vector<PaperTrial>& trials, Holds&& holds) {
  return static_cast<double>(std::count_if(trials.begin(), trials.end(), holds)) /
         static_cast<double>(trials.size());
}

void add_variant(const std::string& row, const std::vector<PaperTrial>& trials, std::size_t pairs,
                 std::vector<Cell>& cells) {
  const auto add = [&](const char* column, const char* unit, const std::vector<double>& values) {
    cells.push_back(own_cell(row, column, unit, values));
  };
  const auto refused = static_cast<double>(pairs - trials.size());
  if (refused > 0) add("pairs with too few keypoints", "pairs", {refused});
  if (trials.empty()) return;
  add("moving points", "", values_of(trials, [](const auto& t) { return t.points_moving; }));
  const double right = share_of(trials, [](const auto& t) { return t.error.is_right(); });
  add("true poses (1 deg, 0.1 m)", "share", {right});
  cells.back().note = fmt::format("n = {}", trials.size());
  add("RMSE of what ICP pairs", "m", values_of(trials, [](const auto& t) { return t.rmse_m; }));
  add("RMSE of the estimate below RMSE of the truth", "share",
      {share_of(trials, [](const auto& t) { return t.rmse_m < t.rmse_at_truth_m; })});
  add("rotation error", "deg",
      values_of(trials, [](const auto& t) { return t.error.rotation_deg; }));
  add("translation error", "m",
      values_of(trials, [](const auto& t) { return t.error.translation_m; }));
}

}  // namespace

ResultTable keypoint_table() {
  return {"keypoints",
          "The keypoint step before ICP, which the paper describes and its numbers do not contain",
          "Grid average 0.05 m, normals of 6 neighbours, keypoints of radius 0.3 m, point-to-plane "
          "ICP from identity; intervals are over pairs.",
          {}};
}

void add_keypoint_cells(const std::string& building, const TwinScans& scans,
                        const std::vector<ScanPair>& pairs,
                        const std::vector<PaperTrial>& every_point, ResultTable& table,
                        const ProgressCallback& progress) {
  add_variant(building + ", every point", every_point, pairs.size(), table.cells);
  PaperIcpOptions options;
  options.keypoints = PaperKeypoints::harris;
  const auto harris = run_paper(scans, pairs, options, progress);
  add_variant(building + ", Harris", harris, pairs.size(), table.cells);
  const double right = share_of(harris, [](const auto& t) { return t.error.is_right(); });
  table.cells.push_back({building, "Harris keypoints are suitable: share of true poses", "", "1",
                         Interval{right, right, right},
                         right > 0.5 ? Verdict::agrees : Verdict::differs,
                         "'3D Harris keypoint able to act as the suitable keypoint method'"});
  options.keypoints = PaperKeypoints::iss;
  add_variant(building + ", ISS", run_paper(scans, pairs, options, progress), pairs.size(),
              table.cells);
}

}  // namespace alea::experiments::markerless
