#include "experiments/markerless/twin_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "alea/simulate/scene_file.hpp"
#include "experiments/markerless/audit.hpp"
#include "experiments/markerless/rank_correlation.hpp"
#include "tests/support/paths.hpp"

namespace alea::experiments::markerless {
namespace {

void expect_same_scene(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.boxes.size(), b.boxes.size());
  ASSERT_EQ(a.cylinders.size(), b.cylinders.size());
  ASSERT_EQ(a.spheres.size(), b.spheres.size());
  ASSERT_EQ(a.stations.size(), b.stations.size());
  for (std::size_t i = 0; i < a.boxes.size(); ++i)
    EXPECT_LT((a.boxes[i].scene_from_box.matrix() - b.boxes[i].scene_from_box.matrix()).norm(),
              1e-6);
  for (std::size_t i = 0; i < a.stations.size(); ++i)
    EXPECT_LT(
        (a.stations[i].scene_from_scan.matrix() - b.stations[i].scene_from_scan.matrix()).norm(),
        1e-6);
}

TEST(TwinScenes, TheFilesAreTheFirstLayout) {
  const std::string folder = alea::testing::source_dir() + "/datasets/markerless/";
  expect_same_scene(load_scene(folder + "bell_tower.toml"), bell_tower({}));
  expect_same_scene(load_scene(folder + "lighthouse.toml"), lighthouse({}));
}

TEST(TwinScenes, LayoutsDifferAndAreRepeatable) {
  TwinOptions other;
  other.layout = 2;
  EXPECT_EQ(as_toml(bell_tower(other), ""), as_toml(bell_tower(other), ""));
  EXPECT_NE(as_toml(bell_tower(other), ""), as_toml(bell_tower({}), ""));
}

TEST(PublishedAudit, NoPairClosesUnderAnyConventionAndAllAveragesAgree) {
  const PublishedTables tables = load_published_tables();
  for (const Convention convention :
       {Convention::equation_3, Convention::transposed, Convention::reversed_order,
        Convention::reversed_transposed}) {
    std::size_t pairs = 0;
    for (const auto* table : {&tables.bell_tower, &tables.lighthouse})
      for (const Misclosure& m : misclosures(*table, convention)) {
        EXPECT_FALSE(m.rotation_deg < 1 && m.translation_m < 0.1) << m.pair;
        ++pairs;
      }
    EXPECT_EQ(pairs, 15u);
  }
  double agree = 0;
  for (const Cell& cell : audit_published(tables).cells)
    if (cell.column == "averages that agree") agree += cell.ours->median;
  EXPECT_EQ(agree, 32);
}

TEST(RankCorrelation, CountsPermutationsExactly) {
  // Three values: 2 of 6 orders are as far from zero as the perfect one.
  const RankCorrelation found = rank_correlation({1, 2, 3}, {2, 4, 9});
  EXPECT_NEAR(found.rho, 1, 1e-12);
  EXPECT_NEAR(found.p_value, 2.0 / 6, 1e-12);
  std::vector<double> a, b;
  for (int i = 0; i < 30; ++i) {
    a.push_back(i);
    b.push_back((i * 7) % 30);
  }
  EXPECT_GT(rank_correlation(a, b).p_value, 0.05);
}

}  // namespace
}  // namespace alea::experiments::markerless
