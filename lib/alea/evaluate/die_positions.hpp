#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "alea/core/progress.hpp"
#include "alea/core/refusal.hpp"
#include "alea/evaluate/error_map.hpp"
#include "alea/evaluate/plan.hpp"

namespace alea {

/// A place for the scene's first die, and what it gives.
struct DiePosition {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double turn_rad = 0;    ///< about the vertical, from how it stands in the scene
  double room_rms_m = 0;  ///< RMS over the area's points, of the worst slave
  std::optional<Refusal> refusal;
};

/// Places on a horizontal grid of `spacing_m` over the area at which the die stands free: its ball
/// apart from every other object but the floor, and 1 m from every station. At its present height.
std::vector<Eigen::Vector3d> free_floor_positions(const Scene& scene, const MapArea& area,
                                                  double spacing_m);

/// The scene with its first die moved to `centre_m` and turned.
Scene with_die_at(const Scene& scene, const Eigen::Vector3d& centre_m, double turn_rad);

/// Every place with the best of the turns, the best place first, those that leave a pose open last;
/// ties keep their order. Windows of angles are not looked at: a scanner is aimed at where the die
/// stands. Throws Error(usage) for a scene without a die.
std::vector<DiePosition> rank_die_positions(const Scene& scene, const PlanAssumptions& assumptions,
                                            const MapArea& area,
                                            const std::vector<Eigen::Vector3d>& centres_m,
                                            const std::vector<double>& turns_rad,
                                            const ProgressCallback& progress = {});

}  // namespace alea
