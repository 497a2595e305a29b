#include "experiments/die/twin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/twin_scenery.hpp"

namespace alea::experiments::die {
namespace {

using std::numbers::pi;

std::vector<PublishedScan> scans_of(const PublishedTables& tables, const std::string& dataset) {
  std::vector<PublishedScan> scans;
  for (const PublishedScan& scan : tables.scans)
    if (scan.dataset == dataset) scans.push_back(scan);
  if (scans.size() != 2) throw usage_error("twin: dataset '" + dataset + "' is none of A to D");
  return scans;
}

// The facets that both scans see, and those that one alone does. Which of the two shared ones was
// on top is not printed: drawn.
void name_facets(const std::vector<PublishedScan>& scans, bool second_on_top, Twin& twin) {
  std::vector<int> shared;
  for (const int pips : scans[0].pips) {
    const auto& other = scans[1].pips;
    if (std::find(other.begin(), other.end(), pips) != other.end())
      shared.push_back(pips);
    else
      twin.master_facet = pips;
  }
  twin.slave_facet = opposite_pips(twin.master_facet);
  twin.top = shared.at(second_on_top ? 1 : 0);
  twin.side = shared.at(second_on_top ? 0 : 1);
}

// A random die whose shared edge has exactly the wanted length.
Die draw_die(const Twin& twin, const TwinPrior& prior, std::uint64_t seed, std::uint32_t experiment,
             std::uint64_t trial) {
  DieModel model;
  model.size_m = Eigen::Vector3d::Constant(twin.true_edge_m);
  model =
      with_random_shape(model, {prior.tilt_sd_rad, prior.offset_sd_m, 0}, seed, experiment, trial);
  model.scene_from_die = standing_pose(model.chirality, twin.top, twin.side, 0,
                                       {0, 0, model.size_m[die_axis(twin.top)] / 2});
  Die die = build_die(model);
  for (int i = 0; i < 4; ++i) {
    const double length = edge_length_m(die.body, twin.top, twin.side);
    model.size_m[die_axis(twin.master_facet)] += twin.true_edge_m - length;
    die = build_die(model);
  }
  return die;
}

// A step for which the die gets as many points as the paper prints: the count goes with 1/step^2.
double step_for_count(const Die& die, const RigidTransform& scene_from_scan, double count) {
  const double coarse_rad = 2e-3 / (scene_from_scan.translation.norm() / 3);
  Scene scene;
  scene.dice.push_back(die);
  Station station = aimed_station(scene_from_scan, bounding_ball(die), coarse_rad);
  station.scanner.noise = {0, 0, 0, 0};
  const double points = static_cast<double>(simulate_scan(scene, station, {}).size());
  return coarse_rad * std::sqrt(points / count);
}

}  // namespace

Twin draw_twin(const PublishedTables& tables, const std::string& dataset, const TwinPrior& prior,
               std::uint64_t seed, std::uint64_t trial) {
  const std::vector<PublishedScan> scans = scans_of(tables, dataset);
  const auto experiment = static_cast<std::uint32_t>(dataset.front());
  RandomStream stream({seed, experiment, trial, 0, Purpose::station});
  const auto between = [&](double low, double high) {
    return std::lerp(low, high, stream.uniform());
  };

  Twin twin;
  twin.dataset = dataset;
  name_facets(scans, stream.uniform() < 0.5, twin);
  for (const PublishedDie& die : tables.dice) {
    if (die.dataset != dataset) continue;
    twin.nominal_edge_m = die.nominal_edge_m;
    twin.true_edge_m = parse_printed(die.calibrated_edge_m).value;
  }
  twin.die = draw_die(twin, prior, seed, experiment, trial);
  twin.edge_direction = twin.die.facets[twin.top - 1]
                            .plane.normal.cross(twin.die.facets[twin.side - 1].plane.normal)
                            .normalized();

  // The master stands on the side of its own facet, the slave opposite.
  const double turn = twin.die.facets[twin.master_facet - 1].plane.normal.y() > 0 ? 1 : -1;
  twin.scanner_height_m = between(prior.scanner_height_m[0], prior.scanner_height_m[1]);
  const Eigen::Vector3d target(0, 0, twin.true_edge_m / 2);
  for (int scan = 0; scan < 2; ++scan) {
    twin.azimuth_rad[scan] = between(-prior.azimuth_half_range_rad, prior.azimuth_half_range_rad);
    const double azimuth = (scan == 0 ? turn : -turn) * (pi / 4 + twin.azimuth_rad[scan]);
    const double rise_m = twin.scanner_height_m - target.z();
    const double floor_m =
        std::sqrt(scans[scan].scanner_to_die_m * scans[scan].scanner_to_die_m - rise_m * rise_m);
    const Eigen::Vector3d place(floor_m * std::cos(azimuth), floor_m * std::sin(azimuth),
                                twin.scanner_height_m);
    twin.scene_from_scan[scan] = levelled_pose(place, between(-pi, pi));
    twin.step_rad[scan] = step_for_count(twin.die, twin.scene_from_scan[scan],
                                         parse_printed(scans[scan].points).value);
  }
  place_scenery(tables, prior, stream, twin);
  return twin;
}

}  // namespace alea::experiments::die
