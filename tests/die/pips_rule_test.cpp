#include "alea/die/pips_rule.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <set>

namespace alea {
namespace {

constexpr std::array both_hands{Chirality::clockwise, Chirality::counterclockwise};

/// Every way to misread one facet of every orientation of both hands.
struct Misread {
  PipTriple truth, counts;
  int error;
  Chirality hand;
};

std::vector<Misread> single_misreads() {
  std::vector<Misread> misreads;
  for (const Chirality hand : both_hands)
    for (const PipTriple& truth : orientations_of(hand))
      for (std::size_t k = 0; k < 3; ++k)
        for (int read = 1; read <= 6; ++read) {
          if (read == truth[k]) continue;
          Misread misread{truth, truth, read - truth[k], hand};
          misread.counts[k] = read;
          misreads.push_back(misread);
        }
  return misreads;
}

TEST(PipsRule, EachHandHas24DistinctOrientationsAndNoneInCommon) {
  std::set<PipTriple> all;
  for (const Chirality hand : both_hands) {
    const auto triples = orientations_of(hand);
    EXPECT_EQ(triples.size(), 24u);
    all.insert(triples.begin(), triples.end());
  }
  EXPECT_EQ(all.size(), 48u);
}

TEST(PipsRule, TheHandIsThatOfTheCommonCornerOfOneTwoThree) {
  // Counterclockwise about the corner, seen from outside, by the order in which facets are given.
  EXPECT_EQ(hand_of({1, 2, 3}), Chirality::counterclockwise);
  EXPECT_EQ(hand_of({3, 2, 1}), Chirality::clockwise);
  EXPECT_EQ(hand_of({1, 2, 6}), std::nullopt);
  EXPECT_EQ(hand_of({1, 2, 0}), std::nullopt);
}

TEST(PipsRule, TheHandAgreesWithTheCubeOfThatHand) {
  for (const Chirality hand : both_hands) {
    const DieShape die = cube(0.5, hand);
    for (const PipTriple& triple : orientations_of(hand)) {
      Eigen::Matrix3d normals;
      for (int k = 0; k < 3; ++k) normals.row(k) = die.facet(triple[k])->normal;
      EXPECT_NEAR(normals.determinant(), 1, 1e-12);
    }
  }
}

TEST(PipsRule, OneMisreadIsNeverResolvedByAnyTwoFacets) {
  double candidates = 0;
  const auto misreads = single_misreads();
  for (const Misread& misread : misreads) {
    const auto fitting = orientations_agreeing(misread.counts, 2, misread.hand);
    EXPECT_GE(fitting.size(), 2u);
    EXPECT_LE(fitting.size(), 3u);
    candidates += static_cast<double>(fitting.size());
    EXPECT_FALSE(resolve_any_two(misread.counts, misread.hand));
  }
  EXPECT_NEAR(candidates / static_cast<double>(misreads.size()), 2.2, 1e-12);
}

TEST(PipsRule, TwoFacetsAloneAcceptSixtyPercentOfSingleMisreads) {
  int accepted = 0, misreads = 0;
  for (const Misread& misread : single_misreads())
    for (std::size_t unread = 0; unread < 3; ++unread) {
      if (misread.counts[unread] != misread.truth[unread]) continue;  // the misread one is used
      PipTriple counts = misread.counts;
      counts[unread] = 0;
      const auto resolved = resolve_any_two(counts, misread.hand);
      ++misreads;
      if (!resolved) continue;
      EXPECT_NE(*resolved, misread.truth);
      ++accepted;
    }
  EXPECT_EQ(5 * accepted, 3 * misreads);
}

TEST(PipsRule, AllThreeFacetsAcceptNoSingleMisread) {
  for (const Misread& misread : single_misreads())
    EXPECT_FALSE(resolve_all_three(misread.counts, misread.hand));
}

TEST(PipsRule, TwoCorrectCountsAndTheHandGiveTheThird) {
  for (const Chirality hand : both_hands)
    for (const PipTriple& truth : orientations_of(hand))
      for (std::size_t unread = 0; unread < 3; ++unread) {
        PipTriple counts = truth;
        counts[unread] = 0;
        const auto resolved = resolve_any_two(counts, hand);
        ASSERT_TRUE(resolved);
        EXPECT_EQ(*resolved, truth);
        EXPECT_FALSE(resolve_all_three(counts, hand));
      }
}

TEST(PipsRule, ADieOfTheOtherHandIsNamedAsSuch) {
  for (const PipTriple& truth : orientations_of(Chirality::counterclockwise)) {
    EXPECT_EQ(resolve_any_two(truth, Chirality::clockwise).refusal().code, RefusalCode::chirality);
    EXPECT_EQ(resolve_all_three(truth, Chirality::clockwise).refusal().code,
              RefusalCode::chirality);
    EXPECT_TRUE(resolve_all_three(truth, std::nullopt));
  }
}

TEST(PipsRule, TooFewCountsAreUnreadable) {
  EXPECT_EQ(resolve_any_two({1, 0, 0}, Chirality::clockwise).refusal().code,
            RefusalCode::pips_unreadable);
  EXPECT_EQ(resolve_all_three({1, 2, 9}, std::nullopt).refusal().code,
            RefusalCode::pips_unreadable);
}

}  // namespace
}  // namespace alea
