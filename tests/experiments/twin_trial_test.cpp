#include "experiments/die/twin_trial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/die/twin_estimate.hpp"

namespace alea::experiments::die {
namespace {

// A sixteenth of the printed points, so that the test is quick.
TwinTrialOptions quick() {
  TwinTrialOptions options;
  options.step_scale = 4;
  options.plane_points = 400;
  options.bounds = true;
  options.prior.noise_scale = {1, 1};
  return options;
}

TEST(TwinTrial, ClosedFormIsNearPerfectAndEquationsOneToEightAreNot) {
  const PublishedTables tables = load_published_tables();
  double closed_form = 0, paper = 0;
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    const TwinOutcome outcome = run_twin(tables, "C", quick(), trial);
    const MethodOutcome& own = outcome.of(TwinMethod::closed_form_independent);
    ASSERT_TRUE(own.registered);
    EXPECT_NEAR(own.edge_m, 0.489, 0.002);
    for (std::size_t k = 0; k < outcome.planes.size(); ++k) {
      EXPECT_LT(own.union_m[k], 1.1 * outcome.of(TwinMethod::perfect).union_m[k]);
      EXPECT_LE(outcome.planes[k].bound_m, outcome.planes[k].widened_bound_m);
      EXPECT_LT(std::abs(own.offset_m[k]), 5 * outcome.planes[k].widened_bound_m);
    }
    closed_form += own.rotation_rad;
    paper += outcome.of(TwinMethod::paper_nominal).rotation_rad;
  }
  EXPECT_GT(paper, 5 * closed_form);
}

TEST(TwinTrial, IsTheSameForAnyNumberOfTwinsBesideIt) {
  const PublishedTables tables = load_published_tables();
  TwinTrialOptions options = quick();
  options.bounds = false;
  const std::vector<TwinOutcome> together = run_twins(tables, "D", options, 2);
  const TwinOutcome alone = run_twin(tables, "D", options, 1);
  EXPECT_EQ(together[1].of(TwinMethod::closed_form_check).union_m,
            alone.of(TwinMethod::closed_form_check).union_m);
  EXPECT_EQ(together[1].die_points, alone.die_points);
}

TEST(TwinTrial, CalibrationOnPlanesThatDoNotSeeTheLengthIsEmpty) {
  const PublishedTables tables = load_published_tables();
  Twin twin = draw_twin(tables, "D", {}, 1, 0);
  for (double& step_rad : twin.step_rad) step_rad *= 4;
  const TwinObservation observed = observe_twin(twin, 1, 0, 200);
  std::erase_if(twin.planes, [](const TwinPlane& plane) { return !plane.check; });
  const auto family = closed_form_family(twin, observed);
  ASSERT_TRUE(family);
  EXPECT_FALSE(calibrate(*family, twin, observed, CalibrationSet::independent));
}

}  // namespace
}  // namespace alea::experiments::die
