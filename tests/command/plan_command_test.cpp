#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/json_schema.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace {

using alea::testing::ProgramRun;
using alea::testing::read_text;
using alea::testing::run_alea;
using alea::testing::TemporaryFolder;
using nlohmann::json;

const std::string quick = alea::testing::source_dir() + "/datasets/die/quick.toml";

TEST(PlanCommand, WritesMapsAndAConformingJson) {
  const TemporaryFolder folder;
  const ProgramRun run =
      run_alea({"plan", quick, "--out", folder.path().string(), "--grid", "2", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json plan = json::parse(std::ifstream(folder.file("plan.json")));
  const auto violations =
      alea::testing::schema_violations(plan, alea::testing::load_schema("plan.v1"));
  EXPECT_TRUE(violations.empty()) << violations.front();
  EXPECT_EQ(plan["status"], "planned");
  EXPECT_FALSE(plan["positions"].empty());
  EXPECT_GT(plan["pairs"][0]["reach_m"], 2.0);
  const std::string png = read_text(folder.file("map_slave.png"));
  EXPECT_EQ(png.substr(1, 3), "PNG");
  std::istringstream csv(read_text(folder.file("map_slave.csv")));
  std::string header;
  std::getline(csv, header);
  EXPECT_EQ(header, "x_m,y_m,z_m,rms_error_m");
  EXPECT_NE(run.out.find("10 m ring holds up to"), std::string::npos) << run.out;
}

TEST(PlanCommand, SetsCheckPlanesBesideThePrediction) {
  const TemporaryFolder folder;
  json plane = {{"id", 1},
                {"centroid_m", {3, 0, 0}},
                {"normal", {0, 0, 1}},
                {"points_master", 500},
                {"points_slave", 400},
                {"alone_master_m", 0.001},
                {"alone_slave_m", 0.001},
                {"union_m", 0.001},
                {"slave_to_master_m", 0.001},
                {"offset_m", 0.0004},
                {"tilt_rad", 0},
                {"role", "check"}};
  json registration = {{"status", "registered"},
                       {"master_from_slave",
                        {{"matrix", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}},
                         {"covariance", nullptr}}},
                       {"check_planes", {plane}}};
  const std::string measured = folder.file("registration.json");
  std::ofstream(measured) << registration;
  const std::vector<std::string> command{"plan",       quick,    "--out",  folder.path().string(),
                                         "--measured", measured, "--quiet"};
  const ProgramRun run = run_alea(command);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json plan = json::parse(std::ifstream(folder.file("plan.json")));
  ASSERT_EQ(plan["pairs"][0]["checks"].size(), 1u);
  EXPECT_EQ(plan["pairs"][0]["checks"][0]["offset_m"], 0.0004);
  EXPECT_GT(plan["pairs"][0]["checks"][0]["predicted_sd_m"], 1e-5);
  registration["status"] = "refused";
  std::ofstream(measured) << registration;
  EXPECT_EQ(run_alea(command).exit_code, 3) << "nothing to compare";
}

TEST(PlanCommand, ExitCodesTellWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  EXPECT_EQ(run_alea({"plan", quick}).exit_code, 2) << "no --out";
  EXPECT_EQ(run_alea({"plan", quick, "--out", out, "--tolerance-mm", "-1"}).exit_code, 2);
  EXPECT_EQ(run_alea({"plan", quick, "--out", out, "--shape", "round"}).exit_code, 2);
  EXPECT_EQ(run_alea({"plan", folder.file("none.toml"), "--out", out}).exit_code, 3);
  std::ofstream(folder.file("file")) << "in the way";
  EXPECT_EQ(run_alea({"plan", quick, "--out", folder.file("file")}).exit_code, 3);
  const std::string no_target = folder.file("bare.toml");
  std::ofstream(no_target) << "[[station]]\nposition_m = [0, 0, 1]\n[[station]]\nname = \"b\"\n"
                              "position_m = [3, 0, 1]\n";
  EXPECT_EQ(run_alea({"plan", no_target, "--out", out}).exit_code, 3);
}

TEST(PlanCommand, APoseThatStaysOpenIsRefusedWithItsJson) {
  const TemporaryFolder folder;
  const std::string scene = folder.file("across.toml");
  std::ofstream(scene) << "[[die]]\ncentre_m = [0, 0, 0.25]\nup = 1\n"
                          "[[station]]\nname = \"a\"\nposition_m = [4, 4, 1.6]\naim_at = \"die\"\n"
                          "[[station]]\nname = \"b\"\nposition_m = [-4, -4, 1.6]\naim_at = "
                          "\"die\"\n";
  const ProgramRun run = run_alea({"plan", scene, "--out", folder.path().string(), "--quiet"});
  EXPECT_EQ(run.exit_code, 4);
  const json plan = json::parse(std::ifstream(folder.file("plan.json")));
  EXPECT_EQ(plan["status"], "refused");
  EXPECT_EQ(plan["refusal"]["code"], "unobservable");
  EXPECT_TRUE(plan["pairs"][0]["covariance"].is_null());
  const auto violations =
      alea::testing::schema_violations(plan, alea::testing::load_schema("plan.v1"));
  EXPECT_TRUE(violations.empty()) << violations.front();
}

}  // namespace
