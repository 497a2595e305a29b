#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "alea/io/cloud_file.hpp"
#include "tests/support/die_scenes.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using testing::ProgramRun;
using testing::read_text;
using testing::run_alea;
using testing::TemporaryFolder;

/// Three small scans of a die: two stations a quarter turn apart and one opposite.
class CalibrateDie : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    for (const int quarter : {1, 2}) {
      testing::TwoStationCase scene;
      scene.station_angle_rad = quarter * 1.5707963267948966;
      scene.step_rad = 2e-3;
      const testing::TwoScans scans =
          testing::scan_twice(scene, static_cast<std::uint64_t>(quarter));
      if (quarter == 1) write_cloud(file("0.ply"), scans.master);
      write_cloud(file(std::to_string(quarter) + ".ply"), scans.slave);
    }
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string file(const std::string& name) { return folder_->file(name); }
  static ProgramRun calibrate(std::vector<std::string> options) {
    std::vector<std::string> arguments{"calibrate",   "die",         file("0.ply"),
                                       file("1.ply"), file("2.ply"), "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_alea(arguments);
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* CalibrateDie::folder_ = nullptr;

TEST_F(CalibrateDie, WritesNullWhereNothingIsKnown) {
  const std::string out = file("open.json");
  const ProgramRun run = calibrate({"--edge", "0.5", "--out", out, "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json die = json::parse(read_text(out)), result = json::parse(run.out);
  EXPECT_TRUE(die["planes"]["6"].is_null());
  EXPECT_FALSE(die["planes"]["1"].is_null());
  for (const json& length : die["edges_m"]) EXPECT_TRUE(length.is_null());
  EXPECT_EQ(result["rank_defect"], 2);
  EXPECT_EQ(result["unobservable"].size(), 2u);
  EXPECT_EQ(testing::schema_violations(result, testing::load_schema("calibrate_die.v1")),
            std::vector<std::string>());
}

TEST_F(CalibrateDie, ACalibratedDieRegistersStationsThatShareOneFacet) {
  const std::string out = file("die.json");
  ASSERT_EQ(calibrate({"--edge", "0.5", "--edge-sd", "0.0005", "--out", out}).exit_code, 0);
  const std::vector<std::string> opposite{
      "register", "die", file("0.ply"), file("2.ply"), "--quiet", "--json", "-"};
  std::vector<std::string> arguments = opposite;
  arguments.insert(arguments.end(), {"--edge", "0.5"});
  EXPECT_EQ(run_alea(arguments).exit_code, 4);
  arguments = opposite;
  arguments.insert(arguments.end(), {"--die", out});
  const ProgramRun run = run_alea(arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  // The die's length along the line of the stations is known to 0.5 mm or so, and no better.
  double variance = 0;
  for (int k = 3; k < 6; ++k)
    variance += result["master_from_slave"]["covariance"][k][k].get<double>();
  EXPECT_GT(variance, 1e-8);
}

TEST_F(CalibrateDie, BadCallsAndInputsAreNamed) {
  EXPECT_EQ(calibrate({"--edge", "0.5"}).exit_code, 2);
  EXPECT_EQ(calibrate({"--edge", "50", "--out", file("x.json")}).exit_code, 2);
  EXPECT_EQ(calibrate({"--edge", "0.5", "--out", "/nonexistent-folder/x.json"}).exit_code, 3);
  const ProgramRun missing = run_alea({"calibrate", "die", file("0.ply"), file("no.ply"), "--edge",
                                       "0.5", "--out", file("x.json")});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.err.find("no.ply"), std::string::npos);
  EXPECT_EQ(calibrate({"--edge", "0.9", "--out", file("x.json")}).exit_code, 4);
  EXPECT_FALSE(std::filesystem::exists(file("x.json")));
}

TEST_F(CalibrateDie, ControlPointsTieTheResultToTheSite) {
  std::ofstream(file("targets.txt")) << "# master frame\nA 0 0 0\nB 10 0 1\nC 3,8,0\n";
  std::ofstream(file("site.txt")) << "A 1000 2000 50\nB 1010 2000 51\nC 1003 2008 50\nD 1 2 3\n";
  std::ofstream(file("two.txt")) << "A 1000 2000 50\nB 1010 2000 51\n";
  std::ofstream(file("bad.txt")) << "A 1000 north 50\n";
  const auto tied = [](std::vector<std::string> options) {
    std::vector<std::string> arguments{
        "register", "die", file("0.ply"), file("1.ply"), "--edge", "0.5", "--quiet", "--json", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_alea(arguments);
  };
  const ProgramRun run = tied({"--control", file("site.txt"), "--targets", file("targets.txt")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json site = json::parse(run.out)["site"];
  EXPECT_EQ(site["points"].size(), 3u);
  EXPECT_NEAR(site["site_from_master"]["matrix"][0][3].get<double>(), 1000, 1e-6);
  EXPECT_LT(site["rmse_m"].get<double>(), 1e-6);
  const ProgramRun few = tied({"--control", file("two.txt"), "--targets", file("targets.txt")});
  EXPECT_EQ(few.exit_code, 4);
  EXPECT_EQ(json::parse(few.out)["refusal"]["code"], "too_few_points");
  EXPECT_EQ(tied({"--control", file("bad.txt"), "--targets", file("targets.txt")}).exit_code, 3);
  EXPECT_EQ(tied({"--control", file("site.txt")}).exit_code, 2);
}

}  // namespace
}  // namespace alea
