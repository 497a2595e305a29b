#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "tests/support/json_schema.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace alea::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* small_sweep = R"(schema = 1
name = "small"
experiment = "die"
estimators = ["closed_form"]
trials = 4
[base]
step_mrad = 5
[[axis]]
name = "range_noise_mm"
values = [0.5, 2]
)";

class SweepCommand : public ::testing::Test {
 protected:
  SweepCommand() { std::ofstream(sweep_) << small_sweep; }
  ProgramRun run(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"sweep", sweep_, "--out", folder_.file(out), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_alea(arguments);
  }

  TemporaryFolder folder_;
  std::string sweep_ = folder_.file("sweep.toml");
};

TEST_F(SweepCommand, RunsResumesAndExports) {
  const ProgramRun first = run("a", {"--json", folder_.file("a.json")});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("8 trials in 2 cells, 8 of them new"));
  const auto summary = nlohmann::json::parse(read_text(folder_.file("a.json")));
  EXPECT_EQ(summary["trials_added"], 8);
  EXPECT_THAT(schema_violations(summary, load_schema("sweep.v1")), ::testing::IsEmpty());
  const ProgramRun again = run("a", {"--resume"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("0 of them new"));
  const ProgramRun csv =
      run_alea({"sweep", "export", folder_.file("a"), "--csv", folder_.file("a.csv")});
  EXPECT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_THAT(read_text(folder_.file("a.csv")),
              HasSubstr("sweep,cell,trial,estimator,range_noise_mm,rotation_error_rad"));
}

TEST_F(SweepCommand, ShardsMerge) {
  EXPECT_EQ(run("1", {"--shard", "1/2"}).exit_code, 0);
  EXPECT_EQ(run("2", {"--shard", "2/2"}).exit_code, 0);
  const auto merge = [&](const std::vector<std::string>& parts, const std::string& out) {
    std::vector<std::string> arguments{"sweep", "merge"};
    for (const std::string& part : parts) arguments.push_back(folder_.file(part));
    arguments.insert(arguments.end(), {"--out", folder_.file(out)});
    return run_alea(arguments);
  };
  EXPECT_EQ(merge({"1", "2"}, "all").exit_code, 0);
  const ProgramRun gap = merge({"1"}, "gap");
  EXPECT_EQ(gap.exit_code, 3);
  EXPECT_THAT(gap.err, HasSubstr("missing"));
  EXPECT_FALSE(fs::exists(folder_.path() / "gap" / "results.sqlite"));
  EXPECT_EQ(merge({"1", "2", "2"}, "double").exit_code, 3);
  EXPECT_EQ(merge({"1", "nowhere"}, "none").exit_code, 3);
  EXPECT_EQ(run_alea({"sweep", "merge", folder_.file("1")}).exit_code, 2) << "--out is missing";
}

TEST_F(SweepCommand, RefusesAnotherConfiguration) {
  EXPECT_EQ(run("a").exit_code, 0);
  EXPECT_EQ(run("a").exit_code, 3) << "never overwrites";
  const std::vector<std::pair<std::vector<std::string>, std::string>> changes{
      {{"--resume", "--seed", "2"}, "seed is 1 there and 2 now"},
      {{"--resume", "--smoke"}, "smoke is false there and true now"},
      {{"--resume", "--shard", "1/2"}, "shard is 1/1 there and 1/2 now"}};
  for (const auto& [options, difference] : changes) {
    const ProgramRun run_again = run("a", options);
    EXPECT_EQ(run_again.exit_code, 3);
    EXPECT_THAT(run_again.err, HasSubstr("another configuration (" + difference + ")"));
  }
}

TEST_F(SweepCommand, SaysWhatIsWrong) {
  EXPECT_EQ(run_alea({"sweep"}).exit_code, 2);
  EXPECT_EQ(run_alea({"sweep", sweep_}).exit_code, 2) << "--out is missing";
  EXPECT_EQ(run("a", {"--shard", "3/2"}).exit_code, 2);
  EXPECT_EQ(run("a", {"--threads", "-1"}).exit_code, 2);
  EXPECT_EQ(run("a", {"--seed", "-1"}).exit_code, 2);
  EXPECT_EQ(run_alea({"sweep", folder_.file("none.toml"), "--out", folder_.file("b")}).exit_code,
            3);
  std::ofstream(sweep_) << "schema = 1\nname = \"x\"\nexperiment = \"die\"\n"
                           "estimators = [\"closed_form\"]\ntrials = -5\n";
  const ProgramRun absurd = run("a");
  EXPECT_EQ(absurd.exit_code, 3);
  EXPECT_THAT(absurd.err, HasSubstr("sweep.toml:5: trials = -5"));
  EXPECT_FALSE(fs::exists(folder_.path() / "a"));
  EXPECT_EQ(run_alea({"sweep", "export", folder_.file("none"), "--csv", "x.csv"}).exit_code, 3);
}

TEST_F(SweepCommand, SaysWhereItCannotWrite) {
  std::ofstream(folder_.file("occupied")) << "a file";
  const ProgramRun occupied = run("occupied");
  EXPECT_EQ(occupied.exit_code, 3);
  EXPECT_THAT(occupied.err, HasSubstr("occupied"));
  EXPECT_EQ(run("a").exit_code, 0);
  const ProgramRun unwritable = run_alea(
      {"sweep", "export", folder_.file("a"), "--csv", folder_.file("missing") + "/rows.csv"});
  EXPECT_EQ(unwritable.exit_code, 3);
  EXPECT_THAT(unwritable.err, HasSubstr("missing"));
}

TEST_F(SweepCommand, AFullDiskLosesNothing) {
  // A limit on the size of files stands for a full disk: 60 blocks of 512 bytes.
  std::ofstream(sweep_) << std::string(small_sweep)
                               .replace(std::string(small_sweep).find("trials = 4"), 10,
                                        "trials = 300");
  const std::string command = testing::program_path() + " sweep " + sweep_ + " --out " +
                              folder_.file("full") + " --quiet --resume";
  const ShellRun full = run_shell("ulimit -f 60; " + command);
  EXPECT_EQ(full.exit_code, 3) << full.output;
  EXPECT_THAT(full.output, HasSubstr("--resume"));
  EXPECT_EQ(run_shell(command).exit_code, 0);
  const ShellRun count = run_shell("sqlite3 " + folder_.file("full") +
                                   "/results.sqlite 'SELECT count(*) FROM trials'");
  EXPECT_THAT(count.output, HasSubstr("600"));
}

TEST_F(SweepCommand, ReportsADamagedStore) {
  EXPECT_EQ(run("a").exit_code, 0);
  fs::resize_file(folder_.path() / "a" / "results.sqlite", 5000);
  const ProgramRun resumed = run("a", {"--resume"});
  EXPECT_EQ(resumed.exit_code, 3);
  EXPECT_EQ(
      run_alea({"sweep", "export", folder_.file("a"), "--csv", folder_.file("a.csv")}).exit_code,
      3);
  EXPECT_FALSE(fs::exists(folder_.path() / "a.csv"));
}

/// The blocks of the engine's page between ```sh and ```.
std::vector<std::string> questions_of_the_page() {
  const std::string page =
      read_text(fs::path(testing::source_dir()) / "experiments" / "engine" / "README.md");
  std::vector<std::string> blocks;
  for (std::size_t at = page.find("```sh\n"); at != std::string::npos;
       at = page.find("```sh\n", at + 1)) {
    const std::size_t begin = at + 6;
    blocks.push_back(page.substr(begin, page.find("\n```", begin) - begin));
  }
  return blocks;
}

TEST_F(SweepCommand, ThePageOfTheEngineAnswersItsThreeQuestions) {
  const ProgramRun made =
      run_alea({"sweep", testing::source_dir() + "/experiments/die/sweeps/range_noise.toml",
                "--smoke", "--quiet", "--out", folder_.file("noise")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::vector<std::string> questions = questions_of_the_page();
  ASSERT_EQ(questions.size(), 3u);
  const std::vector<std::string> expected{"over_bound", "paper_better", "git_commit"};
  for (std::size_t k = 0; k < 3; ++k) {
    const ShellRun answer = run_shell("cd " + folder_.path().string() + " && " + questions[k]);
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    EXPECT_THAT(answer.output, HasSubstr(expected[k]));
    EXPECT_GT(std::count(answer.output.begin(), answer.output.end(), '\n'), 2) << answer.output;
  }
}

}  // namespace
}  // namespace alea::testing
