#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "alea/core/seed.hpp"
#include "alea/io/cloud_file.hpp"
#include "tests/command/json_matrix.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using testing::ProgramRun;
using testing::read_text;
using testing::run_alea;
using testing::TemporaryFolder;

/// A room of 6 x 4 x 3 m with furniture, seen from two places: rays of a coarse scanner.
Cloud room_scan(const Eigen::Vector3d& place, double heading) {
  struct Block {
    Eigen::Vector3d low, high;
  };
  const std::vector<Block> blocks{{{1.5, 1.0, 0}, {2.4, 1.8, 0.8}},
                                  {{-2.8, -1.9, 0}, {-2.0, -0.4, 2.0}},
                                  {{-0.6, 1.6, 0}, {0.4, 2, 1.2}}};
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).matrix();
  RandomStream noise({9, 0, 0, 0, Purpose::test});
  Cloud cloud;
  for (int row = 0; row < 150; ++row)
    for (int column = 0; column < 300; ++column) {
      const double e = -1.2 + 2.5 * row / 150, a = 2 * 3.14159265358979 * column / 300;
      const Eigen::Vector3d beam(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const Eigen::Vector3d d = turn * beam;
      double range = 1e9;
      for (int i = 0; i < 3; ++i) {
        const double low = i == 0 ? -3 : i == 1 ? -2 : 0, high = i == 0 ? 3 : i == 1 ? 2 : 3;
        if (d[i] != 0) range = std::min(range, ((d[i] > 0 ? high : low) - place[i]) / d[i]);
      }
      for (const Block& block : blocks) {
        const Eigen::Array3d t1 = (block.low - place).array() / d.array();
        const Eigen::Array3d t2 = (block.high - place).array() / d.array();
        const double enter = t1.min(t2).maxCoeff(), leave = t1.max(t2).minCoeff();
        if (enter > 0 && enter < leave) range = std::min(range, enter);
      }
      cloud.positions.push_back((range + 0.002 * noise.normal()) * beam);
    }
  return cloud;
}

class MarkerlessCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    write_cloud(file("fixed.ply"), room_scan({-1, -0.5, 1.5}, 0.2));
    write_cloud(file("moving.ply"), room_scan({1.2, -0.8, 1.6}, 1.4));
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string file(const std::string& name) { return folder_->file(name); }
  static ProgramRun markerless(std::vector<std::string> options) {
    std::vector<std::string> arguments{"register", "markerless", file("fixed.ply"),
                                       file("moving.ply"), "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_alea(arguments);
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* MarkerlessCommand::folder_ = nullptr;

void expect_schema(const json& result) {
  const auto problems = testing::schema_violations(result, testing::load_schema("register.v1"));
  EXPECT_TRUE(problems.empty()) << problems.front();
}

TEST_F(MarkerlessCommand, RobustFindsTheRoomFromNothing) {
  const ProgramRun run = markerless({"--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  expect_schema(result);
  EXPECT_EQ(result["method"], "robust");
  const Eigen::Matrix4d m = matrix_of(result["master_from_slave"]["matrix"]);
  // Headings 0.2 and 1.4 rad: the moving scan is turned by 1.2 rad in the fixed one's frame.
  EXPECT_NEAR(std::atan2(m(1, 0), m(0, 0)), 1.2, 0.01);
  EXPECT_NEAR((m.block<3, 1>(0, 3).norm()), std::sqrt(2.2 * 2.2 + 0.3 * 0.3 + 0.01), 0.02);
  EXPECT_FALSE(result["master_from_slave"]["covariance"].is_null());
  EXPECT_GT(result["markerless"]["overlap_fixed"].get<double>(), 0.3);
  EXPECT_GT(result["markerless"]["alternatives"].size(), 0u);
}

TEST_F(MarkerlessCommand, ThreadsDoNotChangeABit) {
  const auto text = [](const ProgramRun& run) {
    json document = json::parse(run.out);
    document.erase("timing_s");
    return document.dump();
  };
  EXPECT_EQ(text(markerless({"--json", "-", "--threads", "1"})),
            text(markerless({"--json", "-", "--threads", "2"})));
}

TEST_F(MarkerlessCommand, ThePaperMethodNeverRefusesAndHasNoCovariance) {
  const ProgramRun run = markerless({"--method", "paper", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  expect_schema(result);
  EXPECT_EQ(result["method"], "paper");
  EXPECT_TRUE(result["master_from_slave"]["covariance"].is_null());
  EXPECT_LE(result["markerless"]["iterations"].get<int>(), 20);
}

TEST_F(MarkerlessCommand, TheKeypointStepIsAVariantOfThePaperMethod) {
  const ProgramRun run = markerless({"--method", "paper", "--keypoints", "iss", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out)["markerless"];
  EXPECT_GT(report["keypoints_fixed"].get<int>(), 6);
  EXPECT_LT(report["keypoints_fixed"].get<int>(), 2000);
  const ProgramRun few = markerless({"--method", "paper", "--keypoints", "harris", "--grid", "2"});
  EXPECT_EQ(few.exit_code, 4) << few.err;
  EXPECT_NE(few.err.find("keypoints"), std::string::npos) << few.err;
}

TEST_F(MarkerlessCommand, ScansOfDifferentPlacesAreRefused) {
  Cloud elsewhere;  // a lone sphere
  RandomStream stream({10, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d d(stream.normal(), stream.normal(), stream.normal());
    elsewhere.positions.push_back(Eigen::Vector3d(6, 0, 0) + 1.5 * d.normalized());
  }
  write_cloud(file("elsewhere.ply"), elsewhere);
  const ProgramRun run = run_alea({"register", "markerless", file("fixed.ply"),
                                   file("elsewhere.ply"), "--quiet", "--json", file("no.json")});
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  const json result = json::parse(read_text(file("no.json")));
  EXPECT_EQ(result["status"], "refused");
  expect_schema(result);
}

TEST_F(MarkerlessCommand, WrongUsageAndBadInputAreToldApart) {
  EXPECT_EQ(markerless({"--method", "magic"}).exit_code, 2);
  EXPECT_EQ(markerless({"--grid=-1"}).exit_code, 2);
  EXPECT_EQ(markerless({"--grid=nan"}).exit_code, 2);
  EXPECT_EQ(markerless({"--keypoints", "harris"}).exit_code, 2);
  EXPECT_EQ(markerless({"--method", "paper", "--keypoint-radius=0"}).exit_code, 2);
  EXPECT_EQ(markerless({"--initial", file("none.txt")}).exit_code, 3);
  EXPECT_EQ(markerless({"--method", "paper", "--json", "/nonexistent-folder/a.json"}).exit_code, 3);
  std::ofstream(file("not_a_cloud.ply")) << "hello\n";
  EXPECT_EQ(
      run_alea({"register", "markerless", file("fixed.ply"), file("not_a_cloud.ply")}).exit_code,
      3);
}

}  // namespace
}  // namespace alea
