#include "alea/die/dbscan.hpp"

#include <gtest/gtest.h>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"

namespace alea {
namespace {

std::vector<Eigen::Vector2d> grid(double x, double y, int side) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) points.emplace_back(x + i, y + j);
  return points;
}

TEST(Dbscan, TwoPatchesAreTwoClustersAndAStrayPointIsNoise) {
  std::vector<Eigen::Vector2d> points = grid(0, 0, 4);
  const auto second = grid(10, 0, 4);
  points.insert(points.end(), second.begin(), second.end());
  points.emplace_back(6, 6);
  const std::vector<int> labels = dbscan(points, {1.0, 3});
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(labels[i], 0);
  for (std::size_t i = 16; i < 32; ++i) EXPECT_EQ(labels[i], 1);
  EXPECT_EQ(labels[32], -1);
}

TEST(Dbscan, TheRimOfTheNeighbourhoodBelongsToIt) {
  const std::vector<Eigen::Vector2d> row{{0, 0}, {1, 0}, {2, 0}};
  EXPECT_EQ(dbscan(row, {1.0, 3}), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(dbscan(row, {0.999, 2}), (std::vector<int>{-1, -1, -1}));
}

TEST(Dbscan, TheCorePointsAreThoseOfTheDefinition) {
  RandomStream stream({3, 0, 0, 0, Purpose::test});
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 300; ++i) points.emplace_back(10 * stream.uniform(), 10 * stream.uniform());
  const DbscanOptions options{0.6, 5};
  const std::vector<int> labels = dbscan(points, options);
  std::vector<std::vector<std::size_t>> near(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      if ((points[i] - points[j]).norm() <= options.radius) near[i].push_back(j);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool core = near[i].size() >= options.min_points;
    bool reached = core;
    for (const std::size_t j : near[i]) {
      const bool core_j = near[j].size() >= options.min_points;
      reached = reached || core_j;
      if (core && core_j) {
        EXPECT_EQ(labels[i], labels[j]);
      }
    }
    EXPECT_EQ(labels[i] >= 0, reached);
  }
}

TEST(Dbscan, ARadiusThatIsNotPositiveIsMisuse) {
  EXPECT_THROW(dbscan(grid(0, 0, 2), {0, 3}), Error);
}

}  // namespace
}  // namespace alea
