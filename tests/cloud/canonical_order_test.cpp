#include "alea/cloud/canonical_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

TEST(CanonicalOrder, ShuffledCloudsBecomeTheSame) {
  RandomStream stream({1, 0, 0, 0, Purpose::test});
  Cloud cloud;
  for (int i = 0; i < 5000; ++i) {
    // Few distinct coordinates, so that ties are broken by the other fields.
    cloud.positions.emplace_back(stream.below(5), stream.below(5), stream.below(5));
    cloud.intensity.push_back(static_cast<float>(stream.below(10)));
    cloud.rows.push_back(static_cast<int>(stream.below(1000)));
  }
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[stream.below(i)]);
  const Cloud a = canonical_order(cloud), b = canonical_order(subset(cloud, order));
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_TRUE(
      std::is_sorted(a.positions.begin(), a.positions.end(), [](const auto& p, const auto& q) {
        return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
      }));
}

TEST(CanonicalOrder, RepeatedPointsCountOnceUnlessTheirIntensityDiffers) {
  Cloud cloud;
  for (const float intensity : {1.0F, 2.0F, 1.0F, 1.0F}) {
    cloud.positions.emplace_back(1, 2, 3);
    cloud.intensity.push_back(intensity);
  }
  cloud.positions.emplace_back(1, 2, 4);
  cloud.intensity.push_back(1);
  const Cloud distinct = without_duplicates(canonical_order(cloud));
  EXPECT_EQ(distinct.size(), 3u);
  EXPECT_EQ(distinct.intensity, (std::vector<float>{1, 2, 1}));
}

}  // namespace
}  // namespace alea
