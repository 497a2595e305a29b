#include "experiments/engine/verdict.hpp"

#include <gtest/gtest.h>

#include "alea/core/error.hpp"

namespace alea::experiments {
namespace {

TEST(PrintedValue, HalfTheLastPrintedDigitIsItsUncertainty) {
  EXPECT_DOUBLE_EQ(parse_printed("1.9").half_digit, 0.05);
  EXPECT_DOUBLE_EQ(parse_printed("0.480").half_digit, 0.0005);
  EXPECT_DOUBLE_EQ(parse_printed("76").half_digit, 0.5);
  EXPECT_DOUBLE_EQ(parse_printed("76").value, 76);
  EXPECT_THROW(parse_printed("about 3"), Error);
  EXPECT_THROW(parse_printed(""), Error);
}

TEST(CentralInterval, InterpolatesBetweenOrderStatistics) {
  std::vector<double> values;
  for (int i = 1000; i >= 0; --i) values.push_back(i);
  const Interval interval = central_interval(values);
  EXPECT_DOUBLE_EQ(interval.low, 25);
  EXPECT_DOUBLE_EQ(interval.median, 500);
  EXPECT_DOUBLE_EQ(interval.high, 975);
}

// Values 1.0 to 2.0 that follow the first omitted datum; the second is unrelated.
std::vector<PriorSample> samples_following_the_height(double spread) {
  std::vector<PriorSample> samples;
  for (int i = 0; i < 300; ++i) {
    const double height = i / 299.0;
    samples.push_back(
        {1 + height + spread * ((i * 7) % 10 - 4.5), {height, (i * 37) % 300 / 299.0}});
  }
  return samples;
}

const std::vector<std::string> names{"scanner height", "station azimuth"};

TEST(Judge, AValueThatMeetsTheIntervalAgrees) {
  std::vector<PriorSample> samples;
  for (int i = 0; i < 300; ++i)
    samples.push_back({1 + (i * 37) % 300 / 299.0, {i / 299.0, (i * 11) % 300 / 299.0}});
  const Judgement inside = judge(parse_printed("1.5"), samples, names);
  EXPECT_EQ(inside.verdict, Verdict::agrees);
  // 1.0 is outside the central 95 %, but 1.0 + 0.05 reaches into it.
  EXPECT_EQ(judge(parse_printed("1.0"), samples, names).verdict, Verdict::agrees);
  EXPECT_EQ(judge(parse_printed("0.9"), samples, names).verdict, Verdict::differs);
  EXPECT_EQ(judge(parse_printed("2.1"), samples, names).verdict, Verdict::differs);
}

TEST(Judge, ADatumThatMovesTheIntervalAcrossTheValueLeavesItUndecidable) {
  const Judgement across = judge(parse_printed("1.50"), samples_following_the_height(0.001), names);
  EXPECT_EQ(across.verdict, Verdict::undecidable);
  EXPECT_EQ(across.datum, "scanner height");
  EXPECT_EQ(judge(parse_printed("3.0"), samples_following_the_height(0.001), names).verdict,
            Verdict::differs);
}

}  // namespace
}  // namespace alea::experiments
