#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "alea/simulate/scanner.hpp"
#include "alea/sphere/sphere_registration.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/engine/sample_mean.hpp"

namespace alea::acceptance {
namespace {

constexpr double radius_m = 0.0725, ring_m = 4, height_m = 1.6;

/// What a topic runs.
struct Study {
  double step_rad = 0;
  std::uint64_t trials = 0;
  /// The control, the geometric fit, runs in the first trials only: its bias needs no more.
  std::uint64_t control_trials = 0;
  std::uint32_t experiment = 0;  ///< key of the random streams
};
constexpr Study against_bound{3e-4, 1000, 1000, 10};
/// A coarse grid, so that a coverage of 10,000 trials is affordable.
constexpr Study coverage{1e-3, 10000, 0, 11};

/// Six spheres on a ring of 4 m, at heights that a tripod allows; the target point is the ring's
/// centre.
std::vector<Eigen::Vector3d> sphere_places() {
  const std::array<double, 6> azimuth_deg{3, 64, 118, 185, 239, 307};
  const std::array<double, 6> place_height_m{0.5, 1.1, 0.7, 1.3, 0.6, 0.9};
  std::vector<Eigen::Vector3d> places;
  for (std::size_t k = 0; k < azimuth_deg.size(); ++k)
    places.emplace_back(ring_m * std::cos(azimuth_deg[k] * deg),
                        ring_m * std::sin(azimuth_deg[k] * deg), place_height_m[k]);
  return places;
}

RigidTransform pose_at(double range_m, double azimuth_rad) {
  return levelled_pose({range_m * std::cos(azimuth_rad), range_m * std::sin(azimuth_rad), height_m},
                       azimuth_rad + std::numbers::pi);
}

FisherScene bound_scene(const std::array<RigidTransform, 2>& poses, double step_rad) {
  FisherScene scene;
  for (const RigidTransform& pose : poses) scene.stations.push_back({pose, step_rad, unknown_sd});
  for (const Eigen::Vector3d& place : sphere_places())
    scene.spheres.push_back({place, radius_m, true});
  return scene;
}

constexpr std::array methods{SphereFitMethod::along_ray, SphereFitMethod::geometric};

/// How many of the methods a trial runs.
std::size_t methods_at(const Study& study, std::uint64_t trial) {
  return trial < study.control_trials ? methods.size() : 1;
}

/// One list of fits for each method.
using FitsOfMethods = std::array<std::vector<SphereFit>, methods.size()>;

/// The six spheres as one station sees them in one trial, fitted one by one. The grid's phase is
/// drawn, so that no cell rests on one fortunate grid.
FitsOfMethods fits_of(const Study& study, const RigidTransform& pose, std::uint32_t scan,
                      std::uint64_t trial, std::uint64_t seed) {
  const RandomStream phases({seed, study.experiment, trial, scan, Purpose::station});
  FitsOfMethods fits;
  const std::vector<Eigen::Vector3d> places = sphere_places();
  for (std::size_t k = 0; k < places.size(); ++k) {
    Scene scene;
    scene.spheres = {{"", places[k], radius_m, 0.9}};
    const auto phase = phases.uniform2_at(k);
    const Station station = aimed_station(pose, bounding_ball(scene.spheres[0]), study.step_rad,
                                          Eigen::Vector2d(phase[0], phase[1]));
    const std::uint32_t part = scan * 16 + static_cast<std::uint32_t>(k);
    const Cloud cloud = simulate_scan(scene, station, {seed, study.experiment, trial, part});
    for (std::size_t m = 0; m < methods_at(study, trial); ++m) {
      SphereFitOptions fit;
      fit.method = methods[m];
      fit.radius_m = radius_m;
      const auto result = fit_sphere(cloud.positions, pose.inverse() * places[k], fit);
      if (result) fits[m].push_back(*result);
    }
  }
  return fits;
}

/// Squared errors of one trial, at the ring's centre.
struct Errors {
  bool registered = false;
  double rotation = 0, translation = 0, nees = 0;
};

Errors errors_of(const std::array<RigidTransform, 2>& poses, const std::vector<SphereFit>& master,
                 const std::vector<SphereFit>& slave) {
  if (master.size() != slave.size()) return {};
  std::vector<SpherePair> pairs;
  for (std::uint32_t k = 0; k < master.size(); ++k) pairs.push_back({k, k});
  const auto result = register_sphere_pairs(master, slave, pairs);
  if (!result) return {};
  const Eigen::Vector3d centre = poses[0].inverse() * Eigen::Vector3d(0, 0, height_m / 2);
  const RigidTransform truth = poses[0].inverse() * poses[1];
  const Vector6d delta = left_difference(truth, result->master_from_slave, centre);
  const Matrix6d covariance = moved_to(result->covariance, centre).covariance;
  return {true, delta.head<3>().squaredNorm(), delta.tail<3>().squaredNorm(),
          delta.dot(covariance.ldlt().solve(delta)) / 6};
}

/// Root mean square over trials with a 95 % interval from the spread of the squares.
Cell ratio_cell(const std::string& name, const std::vector<double>& squares, double bound) {
  const double n = static_cast<double>(squares.size());
  double mean = 0, spread = 0;
  for (const double square : squares) mean += square / n;
  for (const double square : squares) spread += (square - mean) * (square - mean) / (n - 1);
  const double half = 1.96 * std::sqrt(spread / n);
  Cell cell;
  cell.name = name;
  cell.value = std::sqrt(mean) / bound;
  cell.interval = {std::sqrt(std::max(0.0, mean - half)) / bound, std::sqrt(mean + half) / bound};
  cell.n = squares.size();
  return cell;
}

/// The trials of one method against the bound.
void report_method(double range_m, SphereFitMethod method, const std::vector<Errors>& errors,
                   const PoseAccuracy& bound, const Report& report) {
  std::vector<double> rotation, translation, nees;
  for (const Errors& error : errors) {
    if (!error.registered) continue;
    rotation.push_back(error.rotation);
    translation.push_back(error.translation);
    nees.push_back(error.nees);
  }
  const bool control = method == SphereFitMethod::geometric;
  const std::string at = fmt::format("{} at {} m: ", control ? "geometric" : "along ray", range_m);
  Cell rotations = ratio_cell(at + "rotation over bound", rotation, bound.rotation_rad);
  Cell translations = ratio_cell(at + "translation over bound", translation, bound.translation_m);
  rotations.limit = at_most(1.2);
  translations.limit = control ? at_least(1.4) : at_most(1.2);
  if (control) rotations.judgement = Judgement::shown;
  report(rotations);
  report(translations);
  Cell consistency = ratio_cell(at + "root of NEES/6", nees, 1);
  consistency.judgement = Judgement::shown;
  report(consistency);
  std::vector<double> inside;
  for (const double square : nees) inside.push_back(6 * square <= chi_square_95_of_six ? 1 : 0);
  Cell coverage = mean_cell(at + "inside the 95 % region", inside, within(0.95, 0.015));
  coverage.judgement = control ? Judgement::shown : Judgement::point;
  report(coverage);
  Cell refused;
  refused.name = at + "refused";
  refused.value = static_cast<double>(errors.size() - rotation.size());
  refused.interval = {refused.value, refused.value};
  refused.limit = at_most(0);
  refused.n = errors.size();
  report(refused);
}

void report_range(const Study& study, double range_m, const Options& options,
                  const Report& report) {
  const std::array<RigidTransform, 2> poses{pose_at(range_m, std::numbers::pi / 4),
                                            pose_at(range_m, 3 * std::numbers::pi / 4)};
  const PoseAccuracy bound = pose_accuracy(*relative_covariance(
      fisher_bound(bound_scene(poses, study.step_rad)), 0, 1, {0, 0, height_m / 2}));
  const std::uint64_t trials = options.trials_or(study.trials);
  std::array<std::vector<Errors>, methods.size()> errors;
  for (std::size_t m = 0; m < methods.size(); ++m)
    errors[m].resize(m == 0 ? trials : std::min(trials, study.control_trials));
  parallel_chunks(trials, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const FitsOfMethods master = fits_of(study, poses[0], 0, t, options.seed);
      const FitsOfMethods slave = fits_of(study, poses[1], 1, t, options.seed);
      for (std::size_t m = 0; m < methods_at(study, t); ++m)
        errors[m][t] = errors_of(poses, master[m], slave[m]);
    }
  });
  for (std::size_t m = 0; m < methods_at(study, 0); ++m)
    report_method(range_m, methods[m], errors[m], bound, report);
}

}  // namespace

void run_spheres(const Options& options, const Report& report) {
  for (const double range_m : {3.0, 6.0, 9.0, 12.0})
    report_range(against_bound, range_m, options, report);
}

void run_sphere_coverage(const Options& options, const Report& report) {
  for (const double range_m : {3.0, 6.0, 9.0}) report_range(coverage, range_m, options, report);
}

}  // namespace alea::acceptance
