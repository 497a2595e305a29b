#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "alea/evaluate/error_map.hpp"
#include "alea/evaluate/plan.hpp"

namespace alea {

/// What the [plan] table of a scene file asks for.
struct PlanRequest {
  PlanAssumptions assumptions;
  MapArea area;
  double tolerance_m = 0.0025;
  double ring_m = 10;
  std::vector<Eigen::Vector3d> positions_m;  ///< of the die; empty: a grid of free floor positions
  double grid_m = 0;                         ///< spacing of that grid; 0: no search
  std::vector<double> turns_rad;             ///< of the die about the vertical, tried at each place
};

/// Reads the [plan] table of a scene file, defaults where it has none. Throws Error(input) naming
/// file, line and expectation.
PlanRequest load_plan(const std::filesystem::path& path, const Scene& scene);

}  // namespace alea
