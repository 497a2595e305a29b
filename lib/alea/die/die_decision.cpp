#include "alea/die/die_decision.hpp"

#include <algorithm>
#include <utility>

#include "alea/plane/region_decision.hpp"

namespace alea {

DecidedDice decide_dice(const Cloud& cloud, std::vector<PlaneRegion> regions,
                        const DieFinderOptions& options, double tolerance_m, std::uint64_t seed) {
  constexpr std::size_t most_places = 4;
  constexpr double ball_share = 1.2;  // of the edge: holds a cube about the middle of an edge of it
  DieSearch search = search_dice(cloud, regions, options);
  std::vector<FacetPair> pairs = search.pairs;
  const bool found = !search.accepted.empty();
  const std::size_t planes = regions.size();
  DecidedDice out{std::move(regions), result_of(std::move(search), planes, options)};
  if (found) return out;
  pairs.resize(std::min(pairs.size(), most_places));
  for (const FacetPair& pair : pairs) {
    std::vector<PlaneRegion> decided =
        decide_regions(cloud, out.regions, {pair.place_m, ball_share * longest_edge_m(options)},
                       {.tolerance_m = tolerance_m, .seed = seed});
    auto dice = find_dice(cloud, decided, options);
    if (dice) return {std::move(decided), std::move(dice)};
  }
  return out;
}

}  // namespace alea
