#pragma once

#include <cstdint>
#include <vector>

#include "alea/die/die_finder.hpp"

namespace alea {

/// The dice of a scan and the regions that they are made of.
struct DecidedDice {
  std::vector<PlaneRegion> regions;
  Result<std::vector<DieCandidate>> dice;
};

/// find_dice, and where it finds none although two neighbouring planes of a die's size are there:
/// CGAL's detector and the exact kernel decide about up to four such places (decide_regions), and
/// the search is repeated with what they decided. The first search's refusal where that does not
/// help. `tolerance_m` and `seed` of the detector.
DecidedDice decide_dice(const Cloud& cloud, std::vector<PlaneRegion> regions,
                        const DieFinderOptions& options, double tolerance_m, std::uint64_t seed);

}  // namespace alea
