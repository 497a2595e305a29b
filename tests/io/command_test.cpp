#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using ::testing::HasSubstr;
using testing::run_alea;
using testing::TemporaryFolder;

nlohmann::json info_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"info", "--json", "-"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const testing::ProgramRun run = run_alea(all);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out);
}

TEST(Info, SaysWhatTheFileHolds) {
  const TemporaryFolder folder;
  write_file_atomically(
      folder.file("a.csv"),
      "X;Y;Z;Reflectance;gps\n1000;0;0;5;1\n2000;0;0;6;1\nnan;0;0;7;1\n4000;0;0;8;1\n");
  const nlohmann::json info = info_of({folder.file("a.csv"), "--unit", "mm"});
  EXPECT_EQ(info["points"], 3);
  EXPECT_EQ(info["dropped"], (nlohmann::json{{"non_finite", 1}, {"invalid", 0}, {"missing", 0}}));
  EXPECT_EQ(info["fields"], (nlohmann::json{"X", "Y", "Z", "Reflectance", "gps"}));
  EXPECT_EQ(info["min_m"], (nlohmann::json{1.0, 0.0, 0.0}));
  EXPECT_EQ(info["max_m"], (nlohmann::json{4.0, 0.0, 0.0}));
  EXPECT_EQ(info["spacing_m"], 1.0);
  EXPECT_EQ(info["scans"], 1);
  EXPECT_EQ(info["scanner_position_m"], nlohmann::json::array({nullptr}));
}

TEST(Info, ScannerOfEveryScanInTheFrameOfThePoints) {
  const TemporaryFolder folder;
  std::vector<ScanFile> scans(2);
  for (ScanFile& scan : scans) scan.cloud.positions = {{1, 0, 0}, {0, 2, 0}};
  scans[0].pose = Eigen::Matrix4d::Identity();
  scans[1].pose = Eigen::Matrix4d::Identity();
  (*scans[1].pose)(0, 3) = 7;
  write_scans(folder.file("a.e57"), scans);
  const nlohmann::json all = info_of({folder.file("a.e57")});
  EXPECT_EQ(all["scans"], 2);
  EXPECT_EQ(all["points"], 4);
  EXPECT_EQ(all["scanner_position_m"], (nlohmann::json{{0.0, 0.0, 0.0}, {7.0, 0.0, 0.0}}));
  EXPECT_EQ(all["max_m"], (nlohmann::json{8.0, 2.0, 0.0}));
  const nlohmann::json second = info_of({folder.file("a.e57#2")});
  EXPECT_EQ(second["scanner_position_m"], (nlohmann::json{{0.0, 0.0, 0.0}}));
  EXPECT_EQ(second["max_m"], (nlohmann::json{1.0, 2.0, 0.0}));
  const nlohmann::json moved = info_of({folder.file("a.e57#2"), "--apply-pose"});
  EXPECT_EQ(moved["max_m"], (nlohmann::json{8.0, 2.0, 0.0}));
}

TEST(Convert, NamesColumnsCropsAndThins) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 50; ++i) text += std::to_string(i) + " 9 0 0 " + std::to_string(i) + "\n";
  write_file_atomically(folder.file("a.txt"), text);
  const testing::ProgramRun run =
      run_alea({"convert", folder.file("a.txt"), folder.file("b.ply"), "--columns",
                "x,skipped,y,z,intensity", "--crop=10,-1,-1,19,1,1", "--decimate", "4"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Cloud cloud = read_cloud(folder.file("b.ply"));
  EXPECT_EQ(cloud.intensity, (std::vector<float>{10, 14, 18}));
  EXPECT_EQ(
      run_alea({"convert", folder.file("a.txt"), folder.file("b.ply"), "--crop=1,2"}).exit_code, 2);
  EXPECT_EQ(run_alea({"convert", folder.file("a.txt"), folder.file("b.stl")}).exit_code, 3);
}

TEST(Merge, KeepsScansApartWhereTheFormatCan) {
  const TemporaryFolder folder;
  std::vector<ScanFile> one(1);
  one[0].cloud.positions = {{1, 2, 3}};
  one[0].pose = Eigen::Matrix4d::Identity();
  (*one[0].pose)(2, 3) = 10;
  write_scans(folder.file("a.ptx"), one);
  write_cloud(folder.file("b.ply"), one[0].cloud);
  for (const char* out : {"c.e57", "c.ply"}) {
    const testing::ProgramRun run =
        run_alea({"merge", folder.file("a.ptx"), folder.file("b.ply"), "--out", folder.file(out)});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Cloud cloud = read_cloud(folder.file(out));
    ASSERT_EQ(cloud.size(), 2u);
    EXPECT_EQ(cloud.positions[0], Eigen::Vector3d(1, 2, 13));
    EXPECT_EQ(cloud.positions[1], Eigen::Vector3d(1, 2, 3));
  }
  EXPECT_EQ(read_scans(folder.file("c.e57")).size(), 2u);
}

}  // namespace
}  // namespace alea
