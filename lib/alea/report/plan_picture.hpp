#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alea/evaluate/error_map.hpp"
#include "alea/evaluate/plan_check.hpp"
#include "alea/report/picture.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// What a plan's picture shows of one pair of stations.
struct PlanDrawing {
  ErrorMap map;  ///< predicted
  double tolerance_m = 0.0025;
  std::size_t slave = 1;                    ///< station of the scene; the master is 0
  std::optional<Eigen::Vector3d> best_die;  ///< place found for the die, scene frame
  /// After the measurement: the map of the registration's own covariance, and the check planes with
  /// centroids in the scene's frame. Shown in a second panel.
  std::optional<ErrorMap> achieved;
  std::vector<PlanCheck> checks;
};

/// The room from above: the error in colours with contour lines (the tolerance's in bold), walls
/// and furniture, stations, die.
Picture draw_plan(const Scene& scene, const PlanDrawing& drawing);

}  // namespace alea
