#include "experiments/engine/acceptance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "alea/core/error.hpp"

namespace alea::acceptance {
namespace {

TEST(AcceptanceCell, AnIntervalMustLieInsideTheLimitAsAWhole) {
  Cell cell{"ratio", 1.05, {1.03, 1.07}, at_most(1.10), 10000, "", Judgement::interval};
  EXPECT_TRUE(cell.passes());
  cell.interval.high = 1.11;
  EXPECT_FALSE(cell.passes());
  cell.judgement = Judgement::point;
  EXPECT_TRUE(cell.passes());
  cell.value = 1.12;
  EXPECT_FALSE(cell.passes());
  cell.judgement = Judgement::shown;
  EXPECT_TRUE(cell.passes());
}

TEST(AcceptanceCell, NotANumberNeverPasses) {
  const double nan = std::nan("");
  EXPECT_FALSE((Cell{"x", nan, {nan, nan}, within(0, 1), 1, ""}.passes()));
  EXPECT_FALSE((Cell{"x", nan, {nan, nan}, at_least(0), 1, "", Judgement::interval}.passes()));
}

TEST(AcceptanceCell, ItsLineNamesValueIntervalLimitVerdictAndTrials) {
  const Cell cell{"leak", 0.5, {0.4, 0.6}, within(0.5, 0.1), 400, "deg"};
  const std::string line = to_line(cell);
  for (const char* word : {"leak", "0.5 deg", "[0.4, 0.6]", "PASS", "n=400"})
    EXPECT_NE(line.find(word), std::string::npos) << line;
}

TEST(AcceptanceTopics, AnUnknownNameIsMisuse) {
  EXPECT_THROW(topics_named("no such topic"), Error);
}

}  // namespace
}  // namespace alea::acceptance
