#include "alea/pipeline/die_transform.hpp"

#include <gtest/gtest.h>

namespace alea {
namespace {

DieSighting sighting(const std::array<int, 3>& pips, double edge_m, double sd_m) {
  DieSighting out;
  for (int k = 0; k < 3; ++k) out.die.facets[k].pips = pips[k];
  out.edges_m = {edge_m, edge_m, edge_m};
  out.edges_sd_m = {sd_m, sd_m, sd_m};
  return out;
}

TEST(MeasuredEdges, AreNamedByTheFacetsThatMeetInThem) {
  const auto edges =
      measured_edges(sighting({1, 2, 3}, 0.5, 0.001), sighting({1, 2, 4}, 0.5, 0.001));
  std::vector<std::string> names;
  for (const MeasuredEdge& edge : edges) names.push_back(edge.name);
  EXPECT_EQ(names, (std::vector<std::string>{"1-2", "1-3", "1-4", "2-3", "2-4"}));
}

// A point-like beam hides nothing of an edge, so that the 4 mm added for half a footprint are wrong
// in both scans alike: two scans must not make the error look surer than one (edge_unverified).
TEST(MeasuredEdges, TwoScansDoNotHalveAnErrorThatTheyShare) {
  const double sd_m = 0.0023;
  for (const MeasuredEdge& edge :
       measured_edges(sighting({1, 2, 3}, 0.504, sd_m), sighting({1, 2, 3}, 0.504, sd_m))) {
    EXPECT_NEAR(edge.length_m, 0.504, 1e-15);
    EXPECT_NEAR(edge.sd_m, sd_m, 1e-15);
    EXPECT_LT(edge.length_m - 0.5, 3 * edge.sd_m);
  }
}

TEST(MeasuredEdges, TheSurerScanCountsMore) {
  const auto edges =
      measured_edges(sighting({1, 2, 3}, 0.5, 0.001), sighting({1, 2, 3}, 0.51, 0.003));
  EXPECT_NEAR(edges[0].length_m, 0.501, 1e-12);
  EXPECT_NEAR(edges[0].sd_m, 0.0012, 1e-12);
}

}  // namespace
}  // namespace alea
