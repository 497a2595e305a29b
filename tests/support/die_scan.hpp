#pragma once

#include <array>

#include "alea/core/cloud.hpp"
#include "alea/core/plane.hpp"
#include "alea/plane/plane_detector.hpp"
#include "alea/simulate/scene.hpp"

namespace alea::test {

/// A die on the floor scanned from 45 deg off its sides, and its visible facets in the scan's
/// frame: the top (1 pip), then two sides.
struct DieScan {
  Cloud cloud;
  std::array<int, 3> pips{1, 2, 3};
  std::array<Plane, 3> planes;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
};

/// `model` is moved to stand on the floor under the scene's z axis; `others` stands around it.
DieScan scan_die(const DieModel& model, double distance_m, double step_rad, Scene others = {},
                 std::uint64_t trial = 0, const Scanner& scanner = {});

/// What a plane detector gives for the three facets: points within 6 mm, planes 3 mrad off.
std::array<PlaneRegion, 3> die_facets_of(const DieScan& scan);

}  // namespace alea::test
