#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

#include "experiments/command/reproduction_json.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace {

using alea::testing::load_schema;
using alea::testing::ProgramRun;
using alea::testing::run_alea;
using alea::testing::schema_violations;
using nlohmann::json;

std::string listed(const std::vector<std::string>& lines) {
  return std::accumulate(
      lines.begin(), lines.end(), std::string(),
      [](const std::string& all, const std::string& line) { return all + line + "\n"; });
}

void expect_conforming(const json& value, const std::string& schema) {
  const std::vector<std::string> violations = schema_violations(value, load_schema(schema));
  EXPECT_TRUE(violations.empty()) << listed(violations);
}

// Two small scans of a die, made once for all tests.
class Outputs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new alea::testing::TemporaryFolder;
    const std::string scene = alea::testing::source_dir() + "/datasets/die/quick.toml";
    const ProgramRun run = run_alea({"simulate", scene, "--out", folder->path(), "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    truth = json::parse(std::ifstream(folder->file("truth.json")));
    for (const json& scan : truth["scans"]) scans.push_back(folder->file(scan["file"]));
    ASSERT_EQ(scans.size(), 2u);
  }
  static void TearDownTestSuite() {
    delete folder;
    folder = nullptr;
    scans.clear();
  }

  static json output_of(std::vector<std::string> arguments, int exit_code) {
    const std::string file = folder->file("output.json");
    std::filesystem::remove(file);
    arguments.insert(arguments.end(), {"--json", file, "--quiet"});
    const ProgramRun run = run_alea(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    return json::parse(std::ifstream(file));
  }

  static inline alea::testing::TemporaryFolder* folder = nullptr;
  static inline json truth;
  static inline std::vector<std::string> scans;
};

TEST_F(Outputs, TheTruthOfASimulationConforms) {
  expect_conforming(truth, "truth.v1");
}

TEST_F(Outputs, InfoConforms) {
  expect_conforming(output_of({"info", scans[0]}, 0), "info.v1");
}

TEST_F(Outputs, EvaluateConforms) {
  std::ofstream(folder->file("identity.txt")) << "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n";
  expect_conforming(
      output_of({"evaluate", scans[0], scans[1], "--transform", folder->file("identity.txt")}, 0),
      "evaluate.v1");
}

TEST_F(Outputs, ARegistrationConforms) {
  const json result = output_of({"register", "die", scans[0], scans[1], "--edge", "0.5"}, 0);
  EXPECT_EQ(result["status"], "registered");
  EXPECT_FALSE(result["master_from_slave"].is_null());
  expect_conforming(result, "register.v1");
}

TEST_F(Outputs, ARefusedRegistrationConformsAndHasNoTransform) {
  const json result = output_of({"register", "die", scans[0], scans[1], "--edge", "0.3"}, 4);
  EXPECT_EQ(result["status"], "refused");
  EXPECT_TRUE(result["master_from_slave"].is_null());
  EXPECT_FALSE(result["refusal"].is_null());
  expect_conforming(result, "register.v1");
}

TEST(ReproductionOutput, Conforms) {
  using namespace alea::experiments;
  ResultTable table{"table9", "An example", "", {}};
  table.cells.push_back({"A-1", "union", "mm", "1.9", Interval{1, 2, 3}, Verdict::differs, ""});
  table.cells.push_back({"A-2", "union", "mm", "", std::nullopt, Verdict::ours, "refused"});
  table.cells.push_back({"A-3", "points", "", "76", Interval{75, 76, 77}, Verdict::input, ""});
  const json output = alea::command::reproduction_json({table}, 1, true);
  expect_conforming(output, "reproduce.v1");
  EXPECT_EQ(output["tables"][0]["cells"][0]["verdict"], "differs");
  EXPECT_TRUE(output["tables"][0]["cells"][1]["verdict"].is_null());
}

}  // namespace
