#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "alea/die/observed_die.hpp"
#include "experiments/die/plane_moments.hpp"
#include "experiments/die/twin.hpp"

namespace alea::experiments::die {

/// The points of one plane in both scans, each in its scan's frame.
struct TwinPlaneMoments {
  PlaneMoments master, slave;
};

/// What the two scanners bring home from a twin.
struct TwinObservation {
  std::array<ObservedDie, 2> along_ray;   ///< master, slave: facets fitted along the ray
  std::array<ObservedDie, 2> orthogonal;  ///< the same points, fitted along the normal
  std::array<std::size_t, 2> die_points{};
  std::vector<TwinPlaneMoments> planes;                   ///< in the order of Twin::planes
  std::array<std::vector<Eigen::Vector3d>, 2> centres_m;  ///< spheres, in each scan's frame
};

/// Scans the die at the twin's own steps, each plane with about `plane_points` rays and each sphere
/// at 0.3 mrad. Facets and planes are known by the simulator's labels, that is by their rays, and
/// the pips are read without error: what is left is the estimation.
TwinObservation observe_twin(const Twin& twin, std::uint64_t seed, std::uint64_t trial,
                             double plane_points = 1600);

}  // namespace alea::experiments::die
