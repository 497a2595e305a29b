#include "alea/evaluate/plan.hpp"

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

constexpr double farthest_m = 200;

/// Only the die and two stations, which stand `scale` times as far from it as they do.
Scene spread_out(const Scene& scene, std::size_t slave, double scale) {
  Scene out;
  out.dice = {scene.dice.front()};
  out.stations = {scene.stations.front(), scene.stations.at(slave)};
  const Eigen::Vector3d centre = bounding_ball(out.dice.front()).centre_m;
  for (Station& station : out.stations) {
    Eigen::Vector3d& position = station.scene_from_scan.translation;
    position.head<2>() = centre.head<2>() + scale * (position - centre).head<2>();
  }
  return out;
}

double farther_m(const Scene& scene) {
  const Eigen::Vector3d centre = bounding_ball(scene.dice.front()).centre_m;
  double farther = 0;
  for (const Station& station : scene.stations)
    farther = std::max(farther, (station.scene_from_scan.translation - centre).norm());
  return farther;
}

}  // namespace

Eigen::Vector3d target_centre_m(const Scene& scene, const PlanAssumptions& assumptions) {
  if (assumptions.dice && !scene.dice.empty()) return bounding_ball(scene.dice.front()).centre_m;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  if (assumptions.spheres)
    for (const Sphere& sphere : scene.spheres) sum += sphere.centre_m, ++count;
  if (count == 0 && assumptions.planes)
    for (const Patch& patch : scene.patches)
      if (patch.role == PatchRole::calibration) sum += centre_of(patch), ++count;
  return count > 0 ? (sum / count).eval() : sum;
}

std::vector<PlannedPair> plan_pairs(const Scene& scene, const PlanAssumptions& assumptions) {
  const Eigen::Vector3d about = target_centre_m(scene, assumptions);
  std::vector<PlannedPair> pairs;
  const FisherScene all = planned_scene(scene, assumptions);
  if (assumptions.jointly) {
    const FisherBound bound = fisher_bound(all);
    for (std::size_t s = 1; s < all.stations.size(); ++s)
      pairs.push_back({s, relative_covariance(bound, 0, s, about)});
    return pairs;
  }
  for (std::size_t s = 1; s < all.stations.size(); ++s) {
    Scene two = scene;
    two.stations = {scene.stations[0], scene.stations[s]};
    pairs.push_back(
        {s, relative_covariance(fisher_bound(planned_scene(two, assumptions)), 0, 1, about)});
  }
  return pairs;
}

std::optional<double> reach_m(const Scene& scene, const PlanAssumptions& assumptions,
                              const ReachCase& reach) {
  if (scene.dice.empty() || !assumptions.dice) return std::nullopt;
  PlanAssumptions free_field = assumptions;
  free_field.within_windows = free_field.spheres = free_field.planes = false;
  const Eigen::Vector3d up =
      scene.stations.front().scene_from_scan.rotation.transpose() * Eigen::Vector3d::UnitZ();
  const auto holds = [&](double scale) {
    const auto pairs = plan_pairs(spread_out(scene, reach.slave, scale), free_field);
    if (!pairs.front().covariance) return false;
    return ring_error_m(*pairs.front().covariance, reach.ring_m, up) <= reach.tolerance_m;
  };
  const double now_m = farther_m(spread_out(scene, reach.slave, 1));
  const double size_m = scene.dice.front().model.size_m.maxCoeff();
  double near = 2 * size_m / now_m, far = farthest_m / now_m;
  if (!holds(near)) return std::nullopt;
  if (holds(far)) return farther_m(spread_out(scene, reach.slave, far));
  while ((far - near) * now_m > 1e-3) {
    const double middle = (near + far) / 2;
    (holds(middle) ? near : far) = middle;
  }
  return farther_m(spread_out(scene, reach.slave, near));
}

}  // namespace alea
