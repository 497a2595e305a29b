#pragma once

#include <cstdint>
#include <functional>

#include "alea/core/cloud.hpp"
#include "alea/simulate/scene.hpp"

namespace alea::testing {

/// A die on the floor seen by two stations, the master 45 deg off its facets.
struct TwoStationCase {
  double edge_m = 0.5;
  double range_m = 4;
  double step_rad = 1e-3;
  double station_angle_rad = 1.5707963267948966;  ///< from the master to the slave, about the die
  double window_m = 0;  ///< radius about the die that is scanned; 0: its edge
  bool walls = false;   ///< a floor and three walls, seen by both
  /// Changes the die of the scene that scan 0 (master) or 1 (slave) sees.
  std::function<void(DieModel& model, int scan)> change_die;
  /// Changes the whole scene of a scan.
  std::function<void(Scene& scene, int scan)> change_scene;
};

/// Both scans with their truth.
struct TwoScans {
  Cloud master, slave;
  RigidTransform master_from_slave;
  Die die;  ///< as the master sees it, scene frame
};

TwoScans scan_twice(const TwoStationCase& scene_case, std::uint64_t trial = 0);

}  // namespace alea::testing
