#include "alea/evaluate/die_positions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr double least_from_station_m = 1;
constexpr int coarse_cells = 12;  // a side; the square of the error is a quadratic of the place

double distance_to(const Box& box, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = box.scene_from_box.inverse() * p;
  return (q.cwiseAbs() - box.size_m / 2).cwiseMax(0).norm();
}

double distance_to(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const double share = std::clamp(
      cylinder.axis_m.dot(p - cylinder.base_m) / cylinder.axis_m.squaredNorm(), 0.0, 1.0);
  return std::max(0.0, (p - cylinder.base_m - share * cylinder.axis_m).norm() - cylinder.radius_m);
}

double distance_to(const Patch& patch, const Eigen::Vector3d& p) {
  const Eigen::Vector3d from = p - patch.corner_m;
  const auto along = [&](const Eigen::Vector3d& side) {
    return std::clamp(side.dot(from) / side.squaredNorm(), 0.0, 1.0) * side;
  };
  return (from - along(patch.side_u_m) - along(patch.side_v_m)).norm();
}

bool is_free(const Scene& scene, const Eigen::Vector3d& centre, double radius_m) {
  const auto clear = [&](const auto& objects) {
    return std::all_of(objects.begin(), objects.end(),
                       [&](const auto& object) { return distance_to(object, centre) > radius_m; });
  };
  const auto ball_clear = [&](const BoundingBall& ball) {
    return (ball.centre_m - centre).norm() > ball.radius_m + radius_m;
  };
  const bool patches_clear =
      std::all_of(scene.patches.begin(), scene.patches.end(), [&](const Patch& patch) {
        const bool level = std::abs(plane_of(patch).normal.z()) > 0.9;
        return level || distance_to(patch, centre) > radius_m;
      });
  bool apart = true;
  for (std::size_t k = 1; k < scene.dice.size(); ++k)
    apart = apart && ball_clear(bounding_ball(scene.dice[k]));
  for (const Sphere& sphere : scene.spheres) apart = apart && ball_clear(bounding_ball(sphere));
  for (const Checkerboard& board : scene.checkerboards)
    apart = apart && ball_clear(bounding_ball(board));
  for (const Station& station : scene.stations)
    apart = apart && (station.scene_from_scan.translation - centre).head<2>().norm() >
                         std::max(least_from_station_m, radius_m);
  return apart && patches_clear && clear(scene.boxes) && clear(scene.cylinders);
}

/// The RMS over the area of the worst slave, or why there is none.
Result<double> room_error_m(const Scene& scene, const PlanAssumptions& assumptions,
                            const MapArea& area) {
  const RigidTransform master_from_scene = scene.stations.front().scene_from_scan.inverse();
  double worst = 0;
  for (const PlannedPair& pair : plan_pairs(scene, assumptions)) {
    if (!pair.covariance) return pair.covariance.refusal();
    worst =
        std::max(worst, error_map(*pair.covariance, master_from_scene, area).root_mean_square_m());
  }
  return worst;
}

DiePosition best_turn(const Scene& scene, const PlanAssumptions& assumptions, const MapArea& area,
                      const Eigen::Vector3d& centre_m, const std::vector<double>& turns_rad) {
  DiePosition best{centre_m, 0, std::numeric_limits<double>::infinity(), std::nullopt};
  for (const double turn : turns_rad) {
    const Result<double> error =
        room_error_m(with_die_at(scene, centre_m, turn), assumptions, area);
    if (!error && std::isinf(best.room_rms_m)) best.refusal = error.refusal();
    if (!error || *error >= best.room_rms_m) continue;
    best = {centre_m, turn, *error, std::nullopt};
  }
  if (best.refusal) best.room_rms_m = 0;
  return best;
}

}  // namespace

std::vector<Eigen::Vector3d> free_floor_positions(const Scene& scene, const MapArea& area,
                                                  double spacing_m) {
  std::vector<Eigen::Vector3d> places;
  if (scene.dice.empty()) return places;
  const BoundingBall ball = bounding_ball(scene.dice.front());
  MapArea grid = area;
  grid.cell_m = spacing_m;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      Eigen::Vector3d place = grid.at(column, row);
      place.z() = ball.centre_m.z();
      if (is_free(scene, place, ball.radius_m)) places.push_back(place);
    }
  return places;
}

Scene with_die_at(const Scene& scene, const Eigen::Vector3d& centre_m, double turn_rad) {
  Scene moved = scene;
  DieModel model = scene.dice.front().model;
  const Eigen::Vector3d shift = centre_m - bounding_ball(scene.dice.front()).centre_m;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  model.scene_from_die = {turn * model.scene_from_die.rotation,
                          model.scene_from_die.translation + shift};
  moved.dice.front() = build_die(model);
  return moved;
}

std::vector<DiePosition> rank_die_positions(const Scene& scene, const PlanAssumptions& assumptions,
                                            const MapArea& area,
                                            const std::vector<Eigen::Vector3d>& centres_m,
                                            const std::vector<double>& turns_rad,
                                            const ProgressCallback& progress) {
  if (scene.dice.empty() || turns_rad.empty())
    throw usage_error("plan: positions of a die need a [[die]] in the scene and a turn");
  PlanAssumptions anywhere = assumptions;
  anywhere.within_windows = false;
  MapArea coarse = area;
  coarse.cell_m = std::max(area.cell_m, (area.high_m - area.low_m).maxCoeff() / coarse_cells);
  std::vector<DiePosition> positions(centres_m.size());
  constexpr std::size_t batch = 8;
  for (std::size_t from = 0; from < positions.size(); from += batch) {
    const std::size_t count = std::min(batch, positions.size() - from);
    parallel_chunks(count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        positions[from + i] = best_turn(scene, anywhere, coarse, centres_m[from + i], turns_rad);
    });
    if (progress) progress("positions", from + count, positions.size());
  }
  std::stable_sort(positions.begin(), positions.end(),
                   [](const DiePosition& a, const DiePosition& b) {
                     if (a.refusal.has_value() != b.refusal.has_value()) return !a.refusal;
                     return a.room_rms_m < b.room_rms_m;
                   });
  return positions;
}

}  // namespace alea
