#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "alea/io/cloud_file.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using testing::ProgramRun;
using testing::read_text;
using testing::run_alea;
using testing::TemporaryFolder;

/// The quick scene of two stations, simulated once for all tests of this file.
class RegisterCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    const ProgramRun run = run_alea({"simulate", testing::source_dir() + "/datasets/die/quick.toml",
                                     "--out", folder_->path().string(), "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string file(const std::string& name) { return folder_->file(name); }
  static ProgramRun register_die(std::vector<std::string> options) {
    std::vector<std::string> arguments{"register", "die", file("master.ply"), file("slave.ply"),
                                       "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_alea(arguments);
  }
  static Eigen::Matrix4d true_master_from_slave() {
    const json truth = json::parse(read_text(file("truth.json")));
    std::array<Eigen::Matrix4d, 2> scene_from_scan;
    for (int s = 0; s < 2; ++s)
      for (int i = 0; i < 16; ++i)
        scene_from_scan[s](i / 4, i % 4) = truth["scans"][s]["scene_from_scan"][i / 4][i % 4];
    return scene_from_scan[0].inverse() * scene_from_scan[1];
  }

  static TemporaryFolder* folder_;
};
TemporaryFolder* RegisterCommand::folder_ = nullptr;

void expect_one_line(const ProgramRun& run, int exit_code, const std::string& word) {
  EXPECT_EQ(run.exit_code, exit_code) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  EXPECT_TRUE(run.out.empty()) << run.out;
}

TEST_F(RegisterCommand, PrintsTheResultAsJson) {
  const ProgramRun run = register_die({"--edge", "0.5", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  EXPECT_EQ(result["status"], "registered");
  EXPECT_TRUE(result["refusal"].is_null());
  EXPECT_EQ(result["method"], "adjustment");
  EXPECT_EQ(result["die"]["facets"].size(), 6u);
  Eigen::Matrix4d estimate;
  for (int i = 0; i < 16; ++i)
    estimate(i / 4, i % 4) = result["master_from_slave"]["matrix"][i / 4][i % 4];
  EXPECT_LT((estimate - true_master_from_slave()).cwiseAbs().maxCoeff(), 0.02);
}

TEST_F(RegisterCommand, ARefusalWritesItsJsonAndExitsWithFour) {
  const std::string out = file("refused.json");
  expect_one_line(register_die({"--edge", "0.8", "--json", out}), 4, "size_mismatch");
  const json result = json::parse(read_text(out));
  EXPECT_EQ(result["status"], "refused");
  EXPECT_TRUE(result["master_from_slave"].is_null());
  EXPECT_EQ(result["refusal"]["code"], "size_mismatch");
  expect_one_line(run_alea({"apply", out, file("slave.ply"), file("never.ply")}), 3, "refused");
  EXPECT_FALSE(std::filesystem::exists(file("never.ply")));
}

TEST_F(RegisterCommand, AbsurdEdgesAreWrongUsageAndWriteNothing) {
  for (const char* edge : {"-0.5", "0.001", "11", "nan", "0"}) {
    const ProgramRun run =
        register_die({std::string("--edge=") + edge, "--json", file("nothing.json")});
    EXPECT_EQ(run.exit_code, 2) << edge << ": " << run.err;
    EXPECT_FALSE(std::filesystem::exists(file("nothing.json")));
  }
  EXPECT_EQ(register_die({}).exit_code, 2);
}

TEST_F(RegisterCommand, NumbersThatAreNoneAreWrongUsageInOneLine) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--master-origin", "nan,0,0"},
        {"--near", "inf,0,0"},
        {"--threads", "-1"},
        {"--seed", "-1"}}) {
    std::vector<std::string> all{"--edge", "0.5"};
    all.insert(all.end(), options.begin(), options.end());
    const ProgramRun run = register_die(all);
    expect_one_line(run, 2, options[0]);
    EXPECT_LT(run.err.size(), 120u) << run.err;
  }
  expect_one_line(run_alea({"regster"}), 2, "'regster' is not a subcommand");
}

TEST_F(RegisterCommand, BadInputIsNamedWithExitThree) {
  std::ofstream(file("empty.ply"));
  std::ofstream(file("not_a_cloud.ply")) << "hello\n";
  std::ofstream(file("plain.xyz")) << "1 2 3\n4 5 6\n7 8 10\n";
  std::ofstream(file("nan.xyz")) << "nan nan nan 1\nnan nan nan 1\n";
  for (const std::string name :
       {"missing.ply", "empty.ply", "not_a_cloud.ply", "plain.xyz", "nan.xyz", "."}) {
    const ProgramRun run = run_alea({"register", "die", file("master.ply"), file(name), "--edge",
                                     "0.5", "--quiet", "--json", file("no.json")});
    expect_one_line(run, 3, name == "." ? "regular file" : name);
    EXPECT_FALSE(std::filesystem::exists(file("no.json")));
  }
}

TEST_F(RegisterCommand, OutputThatCannotBeWrittenIsExitThree) {
  expect_one_line(register_die({"--edge", "0.5", "--json", "/nonexistent-folder/result.json"}), 3,
                  "/nonexistent-folder");
}

TEST_F(RegisterCommand, ThreadsAndRunsGiveTheSameText) {
  const auto result = [](const ProgramRun& run) {
    json document = json::parse(run.out);
    document.erase("timing_s");
    return document.dump();
  };
  const std::string once = result(register_die({"--edge", "0.5", "--json", "-", "--threads", "1"}));
  EXPECT_EQ(once, result(register_die({"--edge", "0.5", "--json", "-", "--threads", "2"})));
}

TEST_F(RegisterCommand, SeveralSlavesGiveOneResultEach) {
  const ProgramRun run = run_alea({"register", "die", file("master.ply"), file("slave.ply"),
                                   file("slave.ply"), "--edge", "0.5", "--quiet", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  ASSERT_EQ(result["registrations"].size(), 2u);
  EXPECT_EQ(result["registrations"][0]["master_from_slave"], result["master_from_slave"]);
}

TEST_F(RegisterCommand, ATruthFileIsAKnownShape) {
  const ProgramRun run = register_die({"--die", file("truth.json"), "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["status"], "registered");
}

TEST_F(RegisterCommand, ApplyMovesPointsOrWritesThePose) {
  const std::string registration = file("registration.json");
  ASSERT_EQ(register_die({"--edge", "0.5", "--json", registration}).exit_code, 0);
  const json matrix = json::parse(read_text(registration))["master_from_slave"]["matrix"];
  Eigen::Matrix4d expected;
  for (int i = 0; i < 16; ++i) expected(i / 4, i % 4) = matrix[i / 4][i % 4];
  ASSERT_EQ(run_alea({"apply", registration, file("slave.ply"), file("moved.ply")}).exit_code, 0);
  ASSERT_EQ(run_alea({"apply", registration, file("slave.ply"), file("posed.e57")}).exit_code, 0);
  const Cloud slave = read_cloud(file("slave.ply")), moved = read_cloud(file("moved.ply"));
  ASSERT_EQ(slave.size(), moved.size());
  const Eigen::Vector3d first = (expected * slave.positions[0].homogeneous()).head<3>();
  EXPECT_LT((moved.positions[0] - first).norm(), 1e-9);
  const auto posed = read_scans(file("posed.e57"));
  ASSERT_TRUE(posed.size() == 1 && posed[0].pose);
  EXPECT_LT((*posed[0].pose - expected).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((posed[0].cloud.positions[0] - slave.positions[0]).norm(), 1e-9);
}

TEST_F(RegisterCommand, EvaluateTakesSixteenNumbersOrAResult) {
  std::ofstream text(file("matrix.txt"));
  text << std::setprecision(17) << true_master_from_slave() << "\n";
  text.close();
  const ProgramRun run = run_alea({"evaluate", file("master.ply"), file("slave.ply"), "--transform",
                                   file("matrix.txt"), "--quiet", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  // The two shared facets are planes that both scans see.
  ASSERT_GE(result["check_planes"].size(), 2u);
  EXPECT_LT(std::abs(result["check_planes"][0]["offset_m"].get<double>()), 5e-4);
  EXPECT_GT(result["overlap_master"].get<double>(), 0.3);
  std::ofstream(file("short.txt")) << "1 0 0 0";
  expect_one_line(run_alea({"evaluate", file("master.ply"), file("slave.ply"), "--transform",
                            file("short.txt")}),
                  3, "16");
}

}  // namespace
}  // namespace alea
