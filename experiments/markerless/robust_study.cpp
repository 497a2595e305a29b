#include "experiments/markerless/robust_study.hpp"

#include <fmt/format.h>

namespace alea::experiments::markerless {

std::vector<PreparedScan> prepare_scans(const TwinScans& scans) {
  std::vector<PreparedScan> prepared;
  for (const Cloud& cloud : scans.clouds) prepared.push_back(prepare_scan(cloud, {}));
  return prepared;
}

std::vector<RobustTrial> run_robust(const TwinScans& scans,
                                    const std::vector<PreparedScan>& prepared,
                                    const std::vector<ScanPair>& pairs, std::uint64_t seed,
                                    const ProgressCallback& progress) {
  MarkerlessOptions options;
  options.seed = seed;
  std::vector<RobustTrial> trials;
  for (const ScanPair& pair : pairs) {
    RobustTrial trial;
    trial.pair = pair;
    trial.found = register_prepared(prepared[pair.fixed], prepared[pair.moving], options);
    if (const auto& estimate = trial.found.registration.master_from_slave)
      trial.error = pose_error(*estimate, scans.truth(pair.fixed, pair.moving));
    trials.push_back(std::move(trial));
    if (progress) progress("robust pairs", trials.size(), pairs.size());
  }
  return trials;
}

void add_robust_cells(const std::string& building, const std::vector<RobustTrial>& trials,
                      ResultTable& table) {
  int refused = 0, wrong = 0;
  std::vector<double> rotation_deg, translation_m;
  for (const RobustTrial& trial : trials) {
    if (!trial.error)
      ++refused;
    else if (!trial.error->is_right())
      ++wrong;
    else {
      rotation_deg.push_back(trial.error->rotation_deg);
      translation_m.push_back(trial.error->translation_m);
    }
  }
  const auto count = [&](const char* column, std::size_t value) {
    table.cells.push_back(own_cell(building, column, "pairs", {static_cast<double>(value)}));
    table.cells.back().note = fmt::format("of {}", trials.size());
  };
  count("right", rotation_deg.size());
  count("refused", static_cast<std::size_t>(refused));
  count("wrong", static_cast<std::size_t>(wrong));
  if (rotation_deg.empty()) return;
  table.cells.push_back(own_cell(building, "rotation error where right", "deg", rotation_deg));
  table.cells.push_back(own_cell(building, "translation error where right", "m", translation_m));
}

}  // namespace alea::experiments::markerless
