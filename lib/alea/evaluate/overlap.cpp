#include <algorithm>
#include <vector>

#include "alea/cloud/neighbours.hpp"
#include "alea/core/parallel.hpp"
#include "alea/evaluate/check_planes.hpp"

namespace alea {

double overlap_share(const Cloud& a, const Cloud& b, const RigidTransform& b_from_a,
                     double distance_m) {
  if (a.empty() || b.empty()) return 0;
  const NeighbourIndex index(b.positions);
  std::vector<char> covered(a.size());
  parallel_chunks(a.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::vector<Neighbour> nearest = index.nearest(b_from_a * a.positions[i], 1);
      covered[i] = nearest.front().squared_distance_m2 <= distance_m * distance_m;
    }
  });
  const auto count = std::count(covered.begin(), covered.end(), 1);
  return static_cast<double>(count) / static_cast<double>(a.size());
}

}  // namespace alea
