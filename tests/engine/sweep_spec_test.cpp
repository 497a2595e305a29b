#include "experiments/engine/sweep_spec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "alea/core/error.hpp"
#include "experiments/engine/configuration.hpp"
#include "tests/engine/sweep_files.hpp"
#include "tests/support/paths.hpp"

namespace alea::experiments {
namespace {

using alea::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::replaced;
using testing::small_sweep;
using testing::write_file;

SweepSpec load(const std::string& text, bool smoke = false) {
  const TemporaryFolder folder;
  return load_sweep(write_file(folder, text), smoke);
}

std::string message_of(const std::string& text) {
  try {
    load(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "no error";
}

TEST(SweepSpec, TheLastAxisRunsFastest) {
  const SweepSpec spec = load(small_sweep());
  EXPECT_EQ(spec.cells(), 4u);
  EXPECT_EQ(spec.units(), 28u);
  EXPECT_EQ(spec.axis_values(1), (std::vector<SweepValue>{0.5, std::string("parallelepiped")}));
  EXPECT_EQ(spec.axis_values(2), (std::vector<SweepValue>{2.0, std::string("random")}));
  EXPECT_EQ(number_of(spec.settings(2), "range_noise_mm"), 2.0);
  EXPECT_EQ(number_of(spec.settings(2), "edge_m"), 0.5) << "not named, so the default";
}

TEST(SweepSpec, SmokeHasItsOwnTrialsAndValues) {
  const std::string text =
      replaced(small_sweep(), "values = [0.5, 2]", "values = [0.5, 2]\nsmoke_values = [2]");
  EXPECT_EQ(load(text, true).cells(), 2u);
  EXPECT_EQ(load(text, true).trials, 2u);
  EXPECT_EQ(load(text).cells(), 4u);
}

TEST(SweepSpec, AConfigurationHoldsAllThatDecidesTheRows) {
  const SweepSpec spec = load(small_sweep());
  const SweepSpec again = spec_from(configuration_of(spec));
  EXPECT_EQ(configuration_of(again), configuration_of(spec));
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"trials = 7", "trials = 8"},
                                                        {"[0.5, 2]", "[0.5, 2.5]"},
                                                        {"step_mrad = 5", "step_mrad = 6"},
                                                        {"\"paper\"]", "\"polar\"]"},
                                                        {"schema = 1", "schema = 1\nseed = 2"}})
    EXPECT_NE(configuration_of(load(replaced(small_sweep(), from, to))), configuration_of(spec))
        << to;
}

TEST(SweepSpec, NamesTheFirstDifferenceOfTwoConfigurations) {
  const auto difference = [](const std::string& from, const std::string& to) {
    return configuration_difference(configuration_of(load(small_sweep())),
                                    configuration_of(load(replaced(small_sweep(), from, to))));
  };
  EXPECT_EQ(difference("trials = 7", "trials = 7"), "");
  EXPECT_EQ(difference("trials = 7", "trials = 8"), "trials is 7 there and 8 now");
  EXPECT_EQ(difference("step_mrad = 5", "step_mrad = 6"),
            "base.step_mrad is 5.0 there and 6.0 now");
  EXPECT_THAT(difference("[0.5, 2]", "[0.5]"), HasSubstr("axes is "));
}

TEST(SweepSpec, SaysWhichCellIsImpossible) {
  const std::string message = message_of(
      replaced(small_sweep(), "step_mrad = 5", "step_mrad = 5\nrange_m = 5\nedge_m = 9"));
  EXPECT_THAT(message, HasSubstr("sweep.toml: cell 0: range_m = 5 with edge_m = 9"));
}

TEST(SweepSpec, SaysWhereAFileIsWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    return message_of(replaced(small_sweep(), from, to));
  };
  EXPECT_THAT(with("schema = 1", "schema = 9"), HasSubstr("schema = 9"));
  EXPECT_THAT(with("\"die\"", "\"dice\""), HasSubstr("one of die, pips, kernel"));
  EXPECT_THAT(with("\"paper\"", "\"papers\""), HasSubstr("closed_form"));
  EXPECT_THAT(with("step_mrad = 5", "step_mrad = -1"), HasSubstr(":9: base.step_mrad = -1"));
  EXPECT_THAT(with("step_mrad = 5", "stepmrad = 5"), HasSubstr("unknown key 'stepmrad'"));
  EXPECT_THAT(with("[0.5, 2]", "[0.5, 0.5]"), HasSubstr("no value twice"));
  EXPECT_THAT(with("[0.5, 2]", "[]"), HasSubstr("at least one value"));
  EXPECT_THAT(with("\"random\", ", "\"randm\", "), HasSubstr(":17: axis.values"));
  EXPECT_THAT(with("trials = 7", "trials = 0"), HasSubstr("trials = 0"));
  EXPECT_THAT(with("\"tilt_kind\"", "\"range_noise_mm\""), HasSubstr("each once"));
  EXPECT_THAT(message_of(""), HasSubstr("non-empty"));
  EXPECT_THAT(message_of("name = \"x\""), HasSubstr("schema"));
}

TEST(SweepSpec, EveryCommittedSweepLoadsInBothSizes) {
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(alea::testing::source_dir() + "/experiments"))
    if (entry.path().extension() == ".toml") {
      ++count;
      const SweepSpec full = load_sweep(entry.path(), false);
      EXPECT_EQ(full.name, entry.path().stem().string());
      EXPECT_LE(load_sweep(entry.path(), true).units(), 400u) << entry.path();
      EXPECT_GE(full.trials, 100u) << entry.path();
    }
  EXPECT_GE(count, 1u);
}

}  // namespace
}  // namespace alea::experiments
