#include "alea/core/seed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace alea {
namespace {

// Known answers of Random123's kat_vectors for philox4x32-10.
TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, EveryPartOfTheKeyChangesTheStream) {
  const StreamKey base{7, 1, 2, 3, Purpose::range_noise};
  std::set<double> firsts{RandomStream(base).uniform_at(0)};
  StreamKey key = base;
  key.seed = 8;
  firsts.insert(RandomStream(key).uniform_at(0));
  key = base;
  key.experiment = 2;
  firsts.insert(RandomStream(key).uniform_at(0));
  key = base;
  key.trial = 1ULL << 40;
  firsts.insert(RandomStream(key).uniform_at(0));
  key = base;
  key.scan = 4;
  firsts.insert(RandomStream(key).uniform_at(0));
  key = base;
  key.purpose = Purpose::surface_noise;
  firsts.insert(RandomStream(key).uniform_at(0));
  EXPECT_EQ(firsts.size(), 6u);
}

// n = 200,000: the mean's standard error is 1/sqrt(n), the variance's sqrt(2/n), the kurtosis'
// sqrt(24/n); 5 sd each.
TEST(RandomStream, NormalsHaveTheRightMoments) {
  const RandomStream stream({3, 0, 0, 0, Purpose::test});
  const int n = 200000;
  double mean = 0, square = 0, fourth = 0, cross = 0;
  for (int i = 0; i < n; ++i) {
    const auto [a, b] = stream.normal2_at(i);
    mean += a;
    square += a * a;
    fourth += a * a * a * a;
    cross += a * b;
  }
  EXPECT_NEAR(mean / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3, 5 * std::sqrt(96.0 / n));
  EXPECT_NEAR(cross / n, 0, 5 / std::sqrt(n));
}

TEST(RandomStream, SequentialAndRandomAccessAgree) {
  RandomStream sequential({3, 0, 0, 0, Purpose::test});
  const RandomStream random({3, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(sequential.uniform(), random.uniform_at(i));
}

}  // namespace
}  // namespace alea
