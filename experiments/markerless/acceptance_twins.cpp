#include <algorithm>
#include <cmath>

#include "alea/cloud/sampling.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/shuffled_order.hpp"
#include "experiments/engine/wilson.hpp"
#include "experiments/markerless/acceptance.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::acceptance {
namespace {

using namespace experiments::markerless;

void report_falls(const TwinScans& scans, const Report& report) {
  for (std::size_t s = 0; s < scans.clouds.size(); ++s) {
    const auto count = [&](double cell_m) {
      return static_cast<double>(grid_average(scans.clouds[s], cell_m).size());
    };
    const double fine = count(0.025), middle = count(0.05), wide = count(0.1);
    report(point_cell(scans.names[s] + ": fall of the counts, 0.025 to 0.05 m", fine / middle, "",
                      {2.5, 4}, scans.clouds[s].size()));
    report(point_cell(scans.names[s] + ": fall of the counts, 0.05 to 0.1 m", middle / wide, "",
                      {2.5, 4}, scans.clouds[s].size()));
  }
}

/// Everything that a registration says in numbers: whether it is one, the pose with its covariance
/// and every pose that was considered.
std::vector<double> numbers_of(const MarkerlessRegistration& found) {
  std::vector<double> numbers{found.registration.master_from_slave ? 1.0 : 0.0};
  const auto add = [&](const auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      numbers.push_back(matrix(i / matrix.cols(), i % matrix.cols()));
  };
  if (found.report.best) add(found.report.best->matrix());
  if (found.registration.covariance) add(found.registration.covariance->covariance);
  for (const MarkerlessAlternative& other : found.report.alternatives) {
    add(other.fixed_from_moving.matrix());
    numbers.push_back(other.overlap);
    numbers.push_back(other.conflict_ratio);
  }
  return numbers;
}

}  // namespace

void run_markerless_tables(const Options& options, const Report& report) {
  TwinOptions twin;
  twin.layout = options.seed;
  const TwinScans scans = scan_twin(bell_tower(twin), {0, 1}, options.seed);
  PaperIcpOptions every, grid;
  every.cell_m = 0;
  grid.cell_m = 0.1;
  const auto at_truth = [&](const PaperIcpOptions& sampling) {
    return rmse_at(scans.clouds[0], scans.clouds[1], scans.truth(0, 1), sampling);
  };
  report(point_cell("RMSE at the truth, 0.1 m grid over all points",
                    at_truth(grid) / at_truth(every), "", {2, 3}, scans.clouds[1].size()));
  report_falls(scans, report);
}

void run_markerless_paper(const Options& options, const Report& report) {
  std::vector<PaperTrial> all;
  for (std::uint64_t layout = 0; layout < options.trials_or(1); ++layout) {
    TwinOptions twin;
    twin.layout = options.seed + layout;
    twin.step_rad = 8e-3;
    for (const bool tower : {true, false}) {
      const TwinScans scans =
          scan_twin(tower ? bell_tower(twin) : lighthouse(twin), {}, options.seed);
      const auto trials = run_paper(scans, reference_pairs(scans.clouds.size(), tower ? 0 : 5), {});
      all.insert(all.end(), trials.begin(), trials.end());
    }
  }
  const auto n = static_cast<double>(all.size());
  const auto share = [&](const std::string& name, auto&& holds, const Limit& limit) {
    const auto count = static_cast<double>(std::count_if(all.begin(), all.end(), holds));
    report({name, count / n, wilson_interval(count / n, n, 1.96), limit, all.size(), "",
            Judgement::point});
  };
  share(
      "paper's method: true poses", [](const PaperTrial& t) { return t.error.is_right(); },
      at_most(0.1));
  share(
      "paper's method: RMSE of the estimate below that of the truth",
      [](const PaperTrial& t) { return t.rmse_m < t.rmse_at_truth_m; }, at_least(0.5));
}

void run_markerless_bits(const Options& options, const Report& report) {
  TwinOptions twin;
  twin.layout = options.seed;
  twin.step_rad = 8e-3;
  // From outside and from inside: every generator and every stage has its say.
  const TwinScans scans = scan_twin(bell_tower(twin), {0, 5}, options.seed);
  const auto shuffled = [&](const Cloud& cloud) {
    const RandomStream stream({options.seed, 6, 0, 0, Purpose::experiment});
    return subset(cloud, experiments::shuffled_order(cloud.size(), stream));
  };
  const auto numbers = [&](const Cloud& fixed, const Cloud& moving, int threads) {
    const ThreadLimit limit(threads);
    return numbers_of(register_markerless(fixed, moving, {}));
  };
  const auto expected = numbers(scans.clouds[0], scans.clouds[1], 1);
  const auto differing = [&](const std::vector<double>& other) {
    if (other.size() != expected.size()) return static_cast<double>(expected.size());
    double count = 0;
    for (std::size_t i = 0; i < other.size(); ++i) count += other[i] != expected[i] ? 1 : 0;
    return count;
  };
  report(point_cell("registered", expected[0], "", at_least(1), 1));
  report(point_cell("numbers that differ with two threads",
                    differing(numbers(scans.clouds[0], scans.clouds[1], 2)), "", at_most(0),
                    expected.size()));
  report(point_cell("numbers that differ with shuffled points",
                    differing(numbers(shuffled(scans.clouds[0]), shuffled(scans.clouds[1]), 2)), "",
                    at_most(0), expected.size()));
}

}  // namespace alea::acceptance
