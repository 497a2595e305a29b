#pragma once

#include <array>
#include <cstdint>

#include "alea/core/cloud.hpp"
#include "alea/core/result.hpp"
#include "alea/die/observed_die.hpp"
#include "experiments/die/sweep_case.hpp"

namespace alea::experiments::die {

/// Both scans of a trial, simulated.
struct DieScans {
  Die die;
  std::array<Cloud, 2> clouds;
};

/// Scans the die (with a floor where facets are to be detected). The same seed and trial give the
/// same random numbers in every cell.
DieScans scan_die(const DieCase& setting, std::uint64_t seed, std::uint64_t trial);

/// True planes of the three facets that a station sees, in its frame, ascending in pips.
ObservedDie true_sight(const Die& die, const RigidTransform& scene_from_scan);

/// The facets of one scan, found and fitted as the case says; pips are told by the true planes.
/// Refuses where no die is found.
Result<ObservedDie> observe_facets(const DieCase& setting, const DieScans& scans, int scan);

/// The paper's facets: points sorted by their nearest plane, orthogonal fits, no trim.
Result<ObservedDie> observe_as_paper(const DieCase& setting, const DieScans& scans, int scan);

}  // namespace alea::experiments::die
