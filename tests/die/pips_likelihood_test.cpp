#include "alea/die/pips_likelihood.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "alea/core/error.hpp"
#include "experiments/die/pip_trial.hpp"
#include "tests/die/quick_pips.hpp"

namespace alea {
namespace {

struct Score {
  int right = 0, wrong = 0, refused = 0;
};

StreamKey likelihood_key(std::uint64_t trial) {
  return {31, 0, trial, 0, Purpose::test};
}

Score score(const die::PipTrialOptions& options, int trials, const PipReaderOptions& reader = {}) {
  Score score;
  for (int t = 0; t < trials; ++t) {
    const die::PipTrial trial = die::make_pip_trial(options, likelihood_key(t));
    const auto reading = read_pips(trial.images, 1, reader);
    if (!reading)
      ++score.refused;
    else
      ++(reading->pips == trial.pips ? score.right : score.wrong);
  }
  return score;
}

void keep_every(std::size_t step, FacetImageInput& image) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < image.uv_m.size(); i += step, ++kept) {
    image.uv_m[kept] = image.uv_m[i];
    image.intensity[kept] = image.intensity[i];
  }
  image.uv_m.resize(kept);
  image.intensity.resize(kept);
}

TEST(PipsLikelihood, ReadsEveryOrientationAtSixMetres) {
  EXPECT_EQ(score(quick_pips(), 60).right, 60);
}

TEST(PipsLikelihood, ReadsWeakNoisyPipsFarAwayAndIsNotWrongWhereItRefuses) {
  die::PipTrialOptions options = quick_pips();
  options.range_m = 30;
  options.noise_over_contrast = 0.5;
  const Score far = score(options, 200);
  EXPECT_LE(far.wrong, 2);  // 1 % of 200
  EXPECT_GT(far.refused, 20);
  EXPECT_GT(far.right, 60);
}

TEST(PipsLikelihood, IntensityUnitsSignAndFalloffDoNotMatter) {
  die::PipTrialOptions options = quick_pips();
  options.incidence_exponent = 1;
  options.noise_over_contrast = 0.1;
  EXPECT_EQ(score(options, 20).right, 20);
  std::swap(options.background, options.pip);
  EXPECT_EQ(score(options, 20).right, 20);
  for (const auto& [scale, shift] : {std::pair{65535.0F, 0.0F}, {255.0F, 0.0F}, {30.0F, -70.0F}}) {
    die::PipTrial trial = die::make_pip_trial(quick_pips(), likelihood_key(2));
    for (FacetImageInput& image : trial.images)
      for (float& value : image.intensity) value = scale * value + shift;
    const auto reading = read_pips(trial.images, 1);
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->pips, trial.pips);
  }
}

TEST(PipsLikelihood, GlintsAndMissingValuesDoNotDisturb) {
  die::PipTrial trial = die::make_pip_trial(quick_pips(), likelihood_key(5));
  for (FacetImageInput& image : trial.images)
    for (std::size_t i = 0; i < image.intensity.size(); i += 400) {
      image.intensity[i] = 1e6F;
      image.intensity[i + 1] = std::numeric_limits<float>::quiet_NaN();
    }
  const auto reading = read_pips(trial.images, 1);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->pips, trial.pips);
}

TEST(PipsLikelihood, OtherLatticesSizesAndTrimmedBordersAreRead) {
  for (const double offset : {0.22, 0.28})
    for (const double radius : {0.07, 0.11}) {
      die::PipTrialOptions options = quick_pips();
      options.pip_offset = offset;
      options.pip_radius = radius;
      options.trim_m = 0.03;
      EXPECT_EQ(score(options, 15).right, 15) << offset << " " << radius;
    }
  die::PipTrialOptions small = quick_pips();
  small.edge_m = 0.3;
  EXPECT_EQ(score(small, 20).right, 20);
}

TEST(PipsLikelihood, ABlankCubeIsUnreadable) {
  die::PipTrialOptions options = quick_pips();
  options.pip = options.background;
  for (int t = 0; t < 40; ++t) {
    const auto reading = read_pips(die::make_pip_trial(options, likelihood_key(t)).images, 1);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.refusal().code, RefusalCode::pips_unreadable);
  }
}

TEST(PipsLikelihood, MarksThatAreNotPipsAreRefused) {
  RandomStream stream({32, 0, 0, 0, Purpose::test});
  for (int t = 0; t < 60; ++t) {
    die::PipTrial trial = die::make_pip_trial(quick_pips(), likelihood_key(t));
    for (FacetImageInput& image : trial.images) {  // a few dark rectangles instead of pips
      std::vector<Eigen::AlignedBox2d> marks;
      for (int m = 0; m < 4; ++m) {
        const Eigen::Vector2d from(0.4 * stream.uniform(), 0.4 * stream.uniform());
        const Eigen::Vector2d size(0.2 * stream.uniform(), 0.2 * stream.uniform());
        marks.emplace_back(from, from + size);
      }
      for (std::size_t i = 0; i < image.uv_m.size(); ++i) {
        const bool dark = std::any_of(marks.begin(), marks.end(),
                                      [&](const auto& box) { return box.contains(image.uv_m[i]); });
        image.intensity[i] = static_cast<float>((dark ? 0.2 : 0.8) + 0.1 * stream.normal());
      }
    }
    EXPECT_FALSE(read_pips(trial.images, 1)) << t;
  }
}

TEST(PipsLikelihood, PipsThatSitABitOffAreStillPips) {
  die::PipTrialOptions options = quick_pips();
  options.frame_jitter_m = 0.008;
  EXPECT_EQ(score(options, 20).right, 20);
}

TEST(PipsLikelihood, OneFacetThatContradictsTheOthersIsRefused) {
  for (int t = 0; t < 40; ++t) {
    const die::PipTrial die_a = die::make_pip_trial(quick_pips(), likelihood_key(t));
    die::PipTrial mixed = die_a;
    const die::PipTrial die_b = die::make_pip_trial(quick_pips(), likelihood_key(t + 1000));
    mixed.images[1] = die_b.images[1];
    const PipTriple shown{die_a.pips[0], die_b.pips[1], die_a.pips[2]};
    const auto reading = read_pips(mixed.images, 1, {.chirality = std::nullopt});
    if (hand_of(shown)) continue;
    EXPECT_FALSE(reading) << shown[0] << shown[1] << shown[2];
  }
}

TEST(PipsLikelihood, AClearFacetDoesNotAskMoreOfSparseOnes) {
  die::PipTrialOptions options = quick_pips();
  options.range_m = 4;
  options.noise_over_contrast = 0.05;
  int once_refused = 0;
  for (int t = 0; t < 30; ++t) {
    die::PipTrial trial = die::make_pip_trial(options, likelihood_key(t));
    const auto clear = static_cast<std::size_t>(t % 3);
    for (std::size_t k = 0; k < 3; ++k)
      if (k != clear) keep_every(40, trial.images[k]);
    const auto reading = read_pips(trial.images, 1);
    ASSERT_TRUE(reading) << t << reading.refusal().message;
    EXPECT_EQ(reading->pips, trial.pips) << t;
    once_refused += reading->margin < reading->needed_margin ? 1 : 0;
  }
  EXPECT_GE(once_refused, 3);  // 5 % of the clear facet's gain is more than the others can give
}

TEST(PipsLikelihood, TheHandIsReadEvenWhereItIsNotTheExpectedOne) {
  die::PipTrialOptions options = quick_pips();
  const auto right = read_pips(die::make_pip_trial(options, likelihood_key(0)).images, 1);
  options.chirality = Chirality::counterclockwise;
  const die::PipTrial trial = die::make_pip_trial(options, likelihood_key(1));
  const auto other = read_pips(trial.images, 1);
  ASSERT_TRUE(right && other);
  EXPECT_EQ(other->pips, trial.pips);
  EXPECT_EQ(right->hand, Chirality::clockwise);
  EXPECT_EQ(other->hand, Chirality::counterclockwise);
  EXPECT_GT(other->hand_margin, 10);
}

TEST(PipsLikelihood, FacetsInTheOtherOrderGiveTheSameReading) {
  const die::PipTrial trial = die::make_pip_trial(quick_pips(), likelihood_key(7));
  const std::array<FacetImageInput, 3> swapped{trial.images[1], trial.images[0], trial.images[2]};
  const auto reading = read_pips(swapped, -1);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->pips, (std::array{trial.pips[1], trial.pips[0], trial.pips[2]}));
  EXPECT_EQ(reading->hand, Chirality::clockwise);
}

TEST(PipsLikelihood, TheOrderOfPointsDoesNotChangeABit) {
  die::PipTrial trial = die::make_pip_trial(quick_pips(), likelihood_key(8));
  const auto before = read_pips(trial.images, 1);
  for (FacetImageInput& image : trial.images) {
    std::reverse(image.uv_m.begin(), image.uv_m.end());
    std::reverse(image.intensity.begin(), image.intensity.end());
  }
  const auto after = read_pips(trial.images, 1);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->margin, after->margin);
  EXPECT_EQ(before->probability, after->probability);
}

TEST(PipsLikelihood, MisuseIsAnError) {
  const die::PipTrial trial = die::make_pip_trial(quick_pips(), likelihood_key(9));
  EXPECT_THROW(read_pips(trial.images, 0), Error);
  std::array<FacetImageInput, 3> images = trial.images;
  images[2].edge_v_m = 0;
  EXPECT_THROW(read_pips(images, 1), Error);
}

}  // namespace
}  // namespace alea
