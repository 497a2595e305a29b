#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "alea/io/cloud_file.hpp"
#include "tests/support/die_scenes.hpp"
#include "tests/support/png.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

namespace fs = std::filesystem;
using testing::ProgramRun;
using testing::read_text;
using testing::run_alea;
using testing::TemporaryFolder;

/// Two small scans of a die, as files.
class DieReport : public ::testing::Test {
 protected:
  void write(const testing::TwoStationCase& scene_case) {
    const testing::TwoScans scans = testing::scan_twice(scene_case);
    write_cloud(folder_.file("master.ply"), scans.master);
    write_cloud(folder_.file("slave.ply"), scans.slave);
  }
  ProgramRun run(std::vector<std::string> options = {}) {
    std::vector<std::string> arguments{"register",
                                       "die",
                                       folder_.file("master.ply"),
                                       folder_.file("slave.ply"),
                                       "--edge",
                                       "0.5",
                                       "--quiet",
                                       "--report",
                                       report().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_alea(arguments);
  }
  fs::path report() const { return folder_.path() / "report"; }
  Picture picture(const std::string& name) const {
    return testing::decode_png(read_text(report() / name));
  }

  TemporaryFolder folder_;
};

TEST_F(DieReport, ShowsEveryStageOfARegistration) {
  write({.range_m = 3, .step_rad = 4e-3, .walls = true});
  const ProgramRun ran = run({"--calibrate"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const std::string html = read_text(report() / "index.html");
  EXPECT_NE(html.find("registered by"), std::string::npos);
  for (const std::string name :
       {"planes_master.png", "planes_slave.png", "facets_master.png", "facets_slave.png",
        "pips_master.png", "pips_slave.png", "frames.png", "registered.png", "check_planes.png",
        "check_plane_chart.png"}) {
    const Picture drawn = picture(name);
    ASSERT_GT(drawn.width, 300) << name;
    EXPECT_LT(testing::colour_share(drawn, Rgb{255, 255, 255}), 0.995) << name << " is blank";
    EXPECT_NE(html.find("(" + name + ")"), std::string::npos) << name;
  }
  EXPECT_GT(testing::colour_share(picture("facets_master.png"), {58, 125, 68}), 0.01)
      << "points that the fits used are green";
}

TEST_F(DieReport, ARefusalShowsWhatWasFound) {
  testing::TwoStationCase blank{.range_m = 3, .step_rad = 2e-3};
  blank.change_die = [](DieModel& model, int) { model.pips.painted = false; };
  write(blank);
  ASSERT_EQ(run().exit_code, 4);
  const std::string html = read_text(report() / "index.html");
  EXPECT_NE(html.find("refused (pips_unreadable)"), std::string::npos);
  EXPECT_GT(picture("facets_master.png").width, 300);
  EXPECT_GT(picture("pips_slave.png").width, 300);
  EXPECT_FALSE(fs::exists(report() / "frames.png"));
}

TEST_F(DieReport, AScanWithoutADieShowsItsPlanes) {
  testing::TwoStationCase empty{.range_m = 3, .step_rad = 4e-3, .walls = true};
  empty.change_scene = [](Scene& scene, int) { scene.dice.clear(); };
  write(empty);
  ASSERT_EQ(run().exit_code, 4);
  EXPECT_GT(picture("planes_master.png").width, 300);
  EXPECT_FALSE(fs::exists(report() / "facets_master.png"));
}

TEST_F(DieReport, APlaceThatCannotBeWrittenIsBadInputWithoutResult) {
  write({.range_m = 3, .step_rad = 3e-3});
  std::ofstream(report()) << "a file where the folder should be";
  const ProgramRun ran = run({"--json", folder_.file("out.json")});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_NE(ran.err.find("cannot make the folder"), std::string::npos) << ran.err;
  EXPECT_FALSE(fs::exists(folder_.file("out.json")));
}

TEST_F(DieReport, SeveralSlavesHaveAFolderEach) {
  write({.range_m = 3, .step_rad = 3e-3});
  const ProgramRun ran = run_alea({"register", "die", folder_.file("master.ply"),
                                   folder_.file("slave.ply"), folder_.file("slave.ply"), "--edge",
                                   "0.5", "--quiet", "--report", report().string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const std::string slave : {"slave_1", "slave_2"})
    EXPECT_TRUE(fs::exists(report() / slave / "index.html"));
}

}  // namespace
}  // namespace alea
