#include "alea/die/pips_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/die/pip_layout.hpp"
#include "experiments/die/pip_trial.hpp"
#include "tests/die/quick_pips.hpp"

namespace alea {
namespace {

StreamKey chain_key(std::uint64_t trial) {
  return {21, 0, trial, 0, Purpose::test};
}

TEST(PipsChain, CountsTheSideFacetsAtSixMetresForEveryNumber) {
  int right = 0;
  constexpr int trials = 60;
  for (int t = 0; t < trials; ++t) {
    const die::PipTrial trial = die::make_pip_trial(quick_pips(), chain_key(t));
    for (std::size_t k = 0; k < 2; ++k)
      right += count_pips(trial.images[k]).count == trial.pips[k] ? 1 : 0;
  }
  // 119 of 120: the lower 95 % bound of the proportion is then above 0.95.
  EXPECT_GE(right, 2 * trials - 1);
}

TEST(PipsChain, LightPipsOnDarkFacetsCountAsWell) {
  die::PipTrialOptions options = quick_pips();
  options.background = 0.2;
  options.pip = 0.8;
  const die::PipTrial trial = die::make_pip_trial(options, chain_key(1));
  EXPECT_EQ(count_pips(trial.images[0]).count, trial.pips[0]);
}

TEST(PipsChain, CentresLieOnTheLattice) {
  const die::PipTrial trial = die::make_pip_trial(quick_pips(), chain_key(2));
  const PipChainResult result = count_pips(trial.images[0]);
  ASSERT_EQ(result.centres_m.size(), static_cast<std::size_t>(trial.pips[0]));
  for (const Eigen::Vector2d& centre : result.centres_m) {
    double nearest = 1;
    for (int place = 0; place < pip_places; ++place)
      nearest = std::min(nearest, (centre - 0.5 * pip_place(place, 0.25)).norm());
    EXPECT_LT(nearest, 0.025);
  }
}

TEST(PipsChain, TheOrderOfPointsAndTheUnitOfIntensityDoNotMatter) {
  const die::PipTrial trial = die::make_pip_trial(quick_pips(), chain_key(3));
  FacetImageInput image = trial.images[0];
  const PipChainResult before = count_pips(image);
  std::reverse(image.uv_m.begin(), image.uv_m.end());
  std::reverse(image.intensity.begin(), image.intensity.end());
  const PipChainResult reversed = count_pips(image);
  ASSERT_EQ(before.stages.smoothed.pixels.size(), reversed.stages.smoothed.pixels.size());
  for (std::size_t i = 0; i < before.stages.smoothed.pixels.size(); ++i) {
    const float a = before.stages.smoothed.pixels[i], b = reversed.stages.smoothed.pixels[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
  }
  for (float& value : image.intensity) value = 20 * value - 60;  // decibels, below zero
  EXPECT_EQ(count_pips(image).count, trial.pips[0]);
}

TEST(PipsChain, StagesHaveOneShapeAndTheClustersCarryTheCount) {
  const die::PipTrial trial = die::make_pip_trial(quick_pips(), chain_key(4));
  const PipChainResult result = count_pips(trial.images[1]);
  const PipChainStages& s = result.stages;
  for (const GreyImage* image : {&s.raster, &s.smoothed, &s.binary, &s.edges, &s.clusters}) {
    EXPECT_EQ(image->pixels.size(), static_cast<std::size_t>(image->width * image->height));
    EXPECT_EQ(image->width, s.raster.width);
    EXPECT_NEAR(image->width * image->metres_per_pixel, 0.5, image->metres_per_pixel);
  }
  float highest = 0;
  for (const float label : s.clusters.pixels)
    if (!std::isnan(label)) highest = std::max(highest, label);
  EXPECT_EQ(static_cast<int>(highest), result.count);
}

TEST(PipsChain, NothingToSeeGivesNoCount) {
  FacetImageInput image;
  image.edge_u_m = image.edge_v_m = 0.5;
  EXPECT_EQ(count_pips(image).count, 0);
  image.uv_m.assign(100, {0.25, 0.25});
  image.intensity.assign(100, 0.5F);
  EXPECT_EQ(count_pips(image).count, 0);
  image.edge_u_m = 0;
  EXPECT_THROW(count_pips(image), Error);
}

}  // namespace
}  // namespace alea
