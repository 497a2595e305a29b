#include "experiments/die/sweep_die.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "alea/core/rigid_transform.hpp"
#include "experiments/die/sweep_comparators.hpp"
#include "experiments/die/sweep_estimators.hpp"
#include "experiments/engine/cpu_clock.hpp"

namespace alea::experiments::die {
namespace {

SweepBound bound_of(const DieCase& setting, BoundKind kind) {
  switch (kind) {
    case BoundKind::known_shape:
      return die_bound_of(setting, true);
    case BoundKind::free_shape:
      return die_bound_of(setting, false);
    case BoundKind::spheres:
      return spheres_bound(setting);
    case BoundKind::planes:
      return planes_bound(setting);
  }
  return {};
}

/// RMS displacement on a horizontal ring of 10 m about a point (m).
double ring10_m(const RigidTransform& error, const Eigen::Vector3d& centre_m) {
  constexpr int places = 36;
  double sum = 0;
  for (int k = 0; k < places; ++k) {
    const double angle = 2 * std::numbers::pi * k / places;
    const Eigen::Vector3d p = centre_m + 10 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    sum += (error * p - p).squaredNorm();
  }
  return std::sqrt(sum / places);
}

/// The facets of both scans, or why there are none.
struct Observed {
  std::array<ObservedDie, 2> dice;
  std::optional<Refusal> refusal;
  double duration_s = 0;
};

Observed observe_both(const DieCase& setting, const DieScans& scans,
                      Result<ObservedDie> (*observe)(const DieCase&, const DieScans&, int)) {
  const double start = cpu_s();
  Observed out;
  for (int scan = 0; scan < 2 && !out.refusal; ++scan) {
    Result<ObservedDie> found = observe(setting, scans, scan);
    if (found)
      out.dice[scan] = *std::move(found);
    else
      out.refusal = found.refusal();
  }
  out.duration_s = cpu_s() - start;
  return out;
}

class DieCell : public SweepCell {
 public:
  DieCell(const SweepSettings& settings, const std::vector<std::string>& names, std::uint64_t seed)
      : setting_(die_case_of(settings)), seed_(seed) {
    for (const std::string& name : names) {
      estimators_.push_back(&sweep_estimator(name));
      bounds_.push_back(bound_of(setting_, estimators_.back()->bound));
      needs_facets_ = needs_facets_ || estimators_.back()->needs_facets;
      needs_paper_ = needs_paper_ || estimators_.back()->needs_paper_facets;
    }
  }

  std::vector<TrialRow> run(std::uint64_t trial) const override {
    const double start = cpu_s();
    const DieScans scans = needs_facets_ ? scan_die(setting_, seed_, trial) : DieScans{};
    Observed facets, paper;
    if (needs_facets_) facets = observe_both(setting_, scans, observe_facets);
    facets.duration_s = cpu_s() - start;  // the simulation is theirs
    if (needs_paper_) paper = observe_both(setting_, scans, observe_as_paper);
    const SweepSight sight{setting_, scans, facets.dice, paper.dice, seed_, trial};
    std::vector<TrialRow> rows;
    for (std::size_t e = 0; e < estimators_.size(); ++e) {
      const SweepEstimator& estimator = *estimators_[e];
      const double begin = cpu_s();
      double shared_s = 0;
      std::optional<Refusal> refusal;
      if (estimator.needs_facets) {
        shared_s += facets.duration_s;
        refusal = facets.refusal;
      }
      if (estimator.needs_paper_facets) {
        shared_s += paper.duration_s;
        if (!refusal) refusal = paper.refusal;
      }
      rows.push_back(
          row_of(e, refusal ? Result<RigidTransform>(*refusal) : estimator.estimate(sight)));
      rows.back().duration_s = cpu_s() - begin + shared_s;
    }
    return rows;
  }

 private:
  TrialRow row_of(std::size_t e, const Result<RigidTransform>& found) const {
    TrialRow row{estimators_[e]->name};
    row.bound_rotation_rad = bounds_[e].rotation_rad;
    row.bound_translation_m = bounds_[e].translation_m;
    row.bound_check_m = bounds_[e].check_m;
    row.extra = {no_number, bounds_[e].ring10_m};
    if (!found) {
      row.verdict = to_string(found.refusal().code);
      return row;
    }
    row.verdict = "registered";
    const RigidTransform& scene_from_master = setting_.scene_from_scan[0];
    // What the estimate does to points of the scene.
    const RigidTransform error = scene_from_master * *found * setting_.scene_from_scan[1].inverse();
    const Eigen::Vector3d centre(0, 0, setting_.edge_m / 2);
    row.rotation_error_rad = rotation_angle_rad(error.rotation);
    row.translation_error_m = (error * centre - centre).norm();
    row.extra[0] = ring10_m(error, centre);
    double sum = 0;
    for (const CheckPlace& place : check_places())
      sum += std::pow(place.normal.dot(error * place.centroid_m - place.centroid_m), 2);
    row.check_error_m = std::sqrt(sum / static_cast<double>(check_places().size()));
    return row;
  }

  DieCase setting_;
  std::uint64_t seed_;
  std::vector<const SweepEstimator*> estimators_;
  std::vector<SweepBound> bounds_;
  bool needs_facets_ = false, needs_paper_ = false;
};

std::unique_ptr<SweepCell> make_die_cell(const SweepSettings& settings,
                                         const std::vector<std::string>& estimators,
                                         std::uint64_t seed) {
  return std::make_unique<DieCell>(settings, estimators, seed);
}

}  // namespace

SweepExperiment die_sweep() {
  SweepExperiment experiment;
  experiment.name = "die";
  experiment.what = "two scans of a die, facets, transform";
  experiment.parameters = die_parameters();
  for (const SweepEstimator& estimator : sweep_estimators())
    experiment.estimators.push_back(estimator.name);
  experiment.extra_columns = {"ring10_error_m", "bound_ring10_m"};
  experiment.make_cell = make_die_cell;
  experiment.check = [](const SweepSettings& settings) { die_case_of(settings); };
  return experiment;
}

}  // namespace alea::experiments::die
