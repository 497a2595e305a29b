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
  const TwinScans scans = scan_twin(bell_tower(twin), {0, 1}, options.seed);
  const auto shuffled = [&](const Cloud& cloud) {
    const RandomStream stream({options.seed, 6, 0, 0, Purpose::experiment});
    return subset(cloud, experiments::shuffled_order(cloud.size(), stream));
  };
  const auto pose = [&](const Cloud& fixed, const Cloud& moving, int threads) {
    const ThreadLimit limit(threads);
    const auto found = register_markerless(fixed, moving, {});
    Eigen::Matrix<double, 10, 6> bits = Eigen::Matrix<double, 10, 6>::Zero();
    if (!found.registration.master_from_slave) return bits;
    bits.topLeftCorner<4, 4>() = found.registration.master_from_slave->matrix();
    bits.bottomRows<6>() = found.registration.covariance->covariance;
    return bits;
  };
  const auto expected = pose(scans.clouds[0], scans.clouds[1], 1);
  const auto differing = [&](const Eigen::Matrix<double, 10, 6>& other) {
    return static_cast<double>((expected.array() != other.array()).count());
  };
  report(point_cell("registered", expected.isZero() ? 0 : 1, "", at_least(1), 1));
  report(point_cell("numbers that differ with two threads",
                    differing(pose(scans.clouds[0], scans.clouds[1], 2)), "", at_most(0), 52));
  report(point_cell("numbers that differ with shuffled points",
                    differing(pose(shuffled(scans.clouds[0]), shuffled(scans.clouds[1]), 2)), "",
                    at_most(0), 52));
}

}  // namespace alea::acceptance
