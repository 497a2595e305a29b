#include "experiments/die/twin_trial.hpp"

#include <atomic>
#include <mutex>

#include "alea/core/parallel.hpp"
#include "experiments/die/twin_bound.hpp"
#include "experiments/die/twin_estimate.hpp"

namespace alea::experiments::die {
namespace {

MethodOutcome assess(const Twin& twin, const TwinObservation& observed,
                     const RigidTransform& master_from_slave, double edge_m) {
  const RigidTransform truth = twin.master_from_slave();
  const RigidTransform master_from_scene = twin.scene_from_scan[0].inverse();
  const RigidTransform error = master_from_slave * truth.inverse();
  const auto displacement = [&](const Eigen::Vector3d& scene_m) -> Eigen::Vector3d {
    const Eigen::Vector3d p = master_from_scene * scene_m;
    return error * p - p;
  };
  MethodOutcome outcome;
  outcome.registered = true;
  outcome.edge_m = edge_m;
  outcome.rotation_rad = rotation_angle_rad(error.rotation);
  outcome.translation_m = displacement({0, 0, twin.true_edge_m / 2}).norm();
  for (std::size_t k = 0; k < twin.planes.size(); ++k) {
    if (!twin.planes[k].check) continue;
    const PlaneMoments slave = moved(observed.planes[k].slave, master_from_slave);
    outcome.union_m.push_back(fit_rmse_m(joined(observed.planes[k].master, slave)));
    const Eigen::Vector3d normal =
        master_from_scene.rotation * plane_of(twin.planes[k].patch).normal;
    outcome.offset_m.push_back(normal.dot(displacement(centre_of(twin.planes[k].patch))));
  }
  return outcome;
}

class Recorder {
 public:
  Recorder(const Twin& twin, const TwinObservation& observed, TwinOutcome& outcome)
      : twin_(twin), observed_(observed), outcome_(outcome) {}

  void record(TwinMethod method, const std::optional<RigidTransform>& transform, double edge_m) {
    if (transform)
      outcome_.methods[static_cast<std::size_t>(method)] =
          assess(twin_, observed_, *transform, edge_m);
  }

  /// The family with the length on the box, calibrated on the check planes, and on the others.
  void record(TwinMethod nominal, TwinMethod check, TwinMethod independent,
              const std::optional<LengthFamily>& family) {
    if (!family) return;
    record(nominal, family->nominal, twin_.nominal_edge_m);
    const auto calibrated = [&](TwinMethod method, CalibrationSet set) {
      const auto change = calibrate(*family, twin_, observed_, set);
      if (change) record(method, family->at(*change), twin_.nominal_edge_m + (*change)[0]);
    };
    calibrated(check, CalibrationSet::check);
    calibrated(independent, CalibrationSet::independent);
  }

 private:
  const Twin& twin_;
  const TwinObservation& observed_;
  TwinOutcome& outcome_;
};

void describe_planes(const Twin& twin, const TwinObservation& observed, TwinOutcome& outcome) {
  for (std::size_t k = 0; k < twin.planes.size(); ++k) {
    const TwinPlane& plane = twin.planes[k];
    if (!plane.check) continue;
    PlaneOutcome described;
    described.name = plane.name;
    described.vertical = plane.vertical;
    described.along_edge = plane.along_edge;
    described.noise_scale = plane.noise_scale;
    described.alone_master_m = fit_rmse_m(observed.planes[k].master);
    described.alone_slave_m = fit_rmse_m(observed.planes[k].slave);
    outcome.planes.push_back(described);
  }
}

}  // namespace

TwinOutcome run_twin(const PublishedTables& tables, const std::string& dataset,
                     const TwinTrialOptions& options, std::uint64_t trial) {
  Twin twin = draw_twin(tables, dataset, options.prior, options.seed, trial);
  for (double& step_rad : twin.step_rad) step_rad *= options.step_scale;
  const TwinObservation observed = observe_twin(twin, options.seed, trial, options.plane_points);

  TwinOutcome outcome;
  outcome.die_points = observed.die_points;
  outcome.step_rad = twin.step_rad;
  outcome.azimuth_rad = twin.azimuth_rad;
  outcome.scanner_height_m = twin.scanner_height_m;
  for (int scan = 0; scan < 2; ++scan) {
    const auto angles = dihedral_angles(observed.along_ray[scan]);
    for (int k = 0; k < 3; ++k) outcome.angles_rad[scan][k] = angles[k].angle_rad;
  }
  describe_planes(twin, observed, outcome);
  if (options.bounds) add_plane_bounds(twin, observed, outcome);

  Recorder recorder(twin, observed, outcome);
  recorder.record(TwinMethod::perfect, twin.master_from_slave(), 0);
  const std::optional<LengthFamily> closed_form = closed_form_family(twin, observed);
  recorder.record(TwinMethod::closed_form_nominal, TwinMethod::closed_form_check,
                  TwinMethod::closed_form_independent, closed_form);
  if (closed_form && (dataset == "B" || dataset == "C")) {
    const double length_m = parse_printed(tables.dice.front().calibrated_edge_m).value;
    const double change_m = length_m - twin.nominal_edge_m;
    recorder.record(TwinMethod::closed_form_borrowed,
                    closed_form->at(Eigen::VectorXd::Constant(1, change_m)), length_m);
  }
  recorder.record(TwinMethod::paper_nominal, TwinMethod::paper_check, TwinMethod::paper_independent,
                  paper_family(twin, observed, FrameRule::fix_z));
  recorder.record(TwinMethod::nearest_nominal, TwinMethod::nearest_check,
                  TwinMethod::nearest_independent, biased_family(twin, observed, options.bias_rad));
  recorder.record(TwinMethod::spheres_six, sphere_registration(observed, {0, 1, 2, 3, 4, 5}), 0);
  recorder.record(TwinMethod::spheres_four, sphere_registration(observed, {0, 1, 3, 4}), 0);
  return outcome;
}

std::vector<TwinOutcome> run_twins(const PublishedTables& tables, const std::string& dataset,
                                   const TwinTrialOptions& options, std::size_t trials,
                                   const ProgressCallback& progress) {
  std::vector<TwinOutcome> outcomes(trials);
  std::uint64_t done = 0;
  std::mutex progress_mutex;
  parallel_chunks(trials, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t trial = begin; trial < end; ++trial)
      outcomes[trial] = run_twin(tables, dataset, options, trial);
    const std::lock_guard lock(progress_mutex);
    done += end - begin;
    if (progress) progress("twins of dataset " + dataset, done, trials);
  });
  return outcomes;
}

}  // namespace alea::experiments::die
