#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "alea/io/cloud_file.hpp"
#include "alea/simulate/board_sensor.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using testing::load_schema;
using testing::run_alea;
using testing::schema_violations;
using testing::TemporaryFolder;

/// A survey scan of boards whose centres lie at these places, as PLY.
std::string write_boards(const TemporaryFolder& folder, const std::string& name,
                         const std::vector<Eigen::Vector3d>& centres,
                         const RigidTransform& scan_from_scene = {}) {
  Cloud cloud;
  std::uint64_t trial = 100 * name.size() + static_cast<unsigned char>(name[0]);
  for (const Eigen::Vector3d& centre : centres) {
    RigidTransform pose;  // facing the scanner, rows up, a little turned
    const Eigen::Vector3d place = scan_from_scene * centre;
    const Eigen::Vector3d normal = -place.normalized();
    const Eigen::Vector3d columns = Eigen::Vector3d::UnitZ().cross(normal).normalized();
    pose.rotation << columns, normal.cross(columns), normal;
    pose.rotation = pose.rotation * rotation_exp({0.1, 0.1, 0.3});
    pose.translation = place;
    const Cloud one =
        scan_board(Checkerboard{}, pose, survey_sensor(), {1, 0, ++trial, 0, Purpose::test});
    cloud.positions.insert(cloud.positions.end(), one.positions.begin(), one.positions.end());
    cloud.intensity.insert(cloud.intensity.end(), one.intensity.begin(), one.intensity.end());
  }
  const std::string path = folder.file(name);
  write_cloud(path, cloud);
  return path;
}

const std::vector<Eigen::Vector3d> triangle{{9, 1, 0.5}, {9, -1.5, 0}, {9.5, 0.3, -1}};

TEST(MeasureCheckerboard, GivesACentreThatConformsToTheSchema) {
  const TemporaryFolder folder;
  const std::string scan = write_boards(folder, "one.ply", {{10, 0, 0}});
  for (const std::string method : {"likelihood", "coloured_icp"}) {
    const auto run = run_alea({"measure", "checkerboard", scan, "--side", "0.15", "--near",
                               "10,0.02,0.03", "--method", method, "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json result = json::parse(run.out);
    const auto violations = schema_violations(result, load_schema("measure_checkerboard.v1"));
    EXPECT_TRUE(violations.empty()) << violations.front();
    EXPECT_EQ(result["status"], "measured");
    EXPECT_NEAR(result["centre_m"][0].get<double>(), 10, 2e-3);
    EXPECT_EQ(result["covariance"].is_null(), method == "coloured_icp");
    EXPECT_FALSE(result.contains("targets"));
  }
}

TEST(MeasureCheckerboard, FindsAllTargetsWithoutAPlace) {
  const TemporaryFolder folder;
  const std::string scan = write_boards(folder, "three.ply", triangle);
  const auto run = run_alea({"measure", "checkerboard", scan, "--side", "0.15", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  EXPECT_TRUE(schema_violations(result, load_schema("measure_checkerboard.v1")).empty());
  EXPECT_EQ(result["targets"].size(), 3u);
  EXPECT_EQ(result["targets"][0]["centre_m"], result["centre_m"]);
}

TEST(MeasureCheckerboard, RefusesWithExitFourAndNoCentre) {
  const TemporaryFolder folder;
  const std::string scan = write_boards(folder, "one.ply", {{10, 0, 0}});
  const std::string out = folder.file("out.json");
  const auto run = run_alea(
      {"measure", "checkerboard", scan, "--side", "0.2", "--near", "10,0,0", "--json", out});
  EXPECT_EQ(run.exit_code, 4);
  const json result = json::parse(std::ifstream(out));
  EXPECT_EQ(result["status"], "refused");
  EXPECT_TRUE(result["centre_m"].is_null());
  EXPECT_EQ(result["refusal"]["code"], "size_mismatch");
  EXPECT_TRUE(schema_violations(result, load_schema("measure_checkerboard.v1")).empty());
}

TEST(MeasureCheckerboard, TellsWrongUsageFromBadInput) {
  const TemporaryFolder folder;
  const std::string scan = write_boards(folder, "one.ply", {{10, 0, 0}});
  const auto code = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"measure", "checkerboard"});
    return run_alea(arguments).exit_code;
  };
  EXPECT_EQ(code({scan}), 2);
  EXPECT_EQ(code({scan, "--side", "-1"}), 2);
  EXPECT_EQ(code({scan, "--side", "nan"}), 2);
  EXPECT_EQ(code({scan, "--side", "0.15", "--squares", "2"}), 2);
  EXPECT_EQ(code({scan, "--side", "0.15", "--squares", "1x1"}), 2);
  EXPECT_EQ(code({scan, "--side", "0.15", "--near", "1,2"}), 2);
  EXPECT_EQ(code({scan, "--side", "0.15", "--method", "magic"}), 2);
  EXPECT_EQ(code({folder.file("missing.ply"), "--side", "0.15"}), 3);
  EXPECT_EQ(code({scan, "--side", "0.15", "--near", "10,0,0", "--json", "/nowhere/x.json"}), 3);
  std::ofstream(folder.file("bare.xyz")) << "1 2 3\n4 5 6\n7 8 10\n";
  EXPECT_EQ(code({folder.file("bare.xyz"), "--side", "0.15"}), 3);
  std::ofstream(folder.file("text.ply")) << "no cloud\n";
  EXPECT_EQ(code({folder.file("text.ply"), "--side", "0.15"}), 3);
}

TEST(RegisterCheckerboards, FindsTheTransformAndRefusesCollinearTargets) {
  const TemporaryFolder folder;
  const RigidTransform slave_from_master{rotation_exp({0, 0, 0.2}), {0.5, -0.3, 0.1}};
  const std::string master = write_boards(folder, "master.ply", triangle);
  const std::string slave = write_boards(folder, "slave.ply", triangle, slave_from_master);
  const auto run =
      run_alea({"register", "checkerboards", master, slave, "--side", "0.15", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  const auto violations = schema_violations(result, load_schema("register.v1"));
  EXPECT_TRUE(violations.empty()) << violations.front();
  Eigen::Matrix4d matrix;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) matrix(r, c) = result["master_from_slave"]["matrix"][r][c];
  const RigidTransform off = RigidTransform::from_matrix(matrix) * slave_from_master;
  EXPECT_LT((off * Eigen::Vector3d(9, 0, 0) - Eigen::Vector3d(9, 0, 0)).norm(), 1e-3);

  const std::vector<Eigen::Vector3d> line{{9, -1, 0}, {9, 0.2, 0}, {9, 1, 0}};
  const auto refused = run_alea({"register", "checkerboards", write_boards(folder, "a.ply", line),
                                 write_boards(folder, "b.ply", line), "--side", "0.15"});
  EXPECT_EQ(refused.exit_code, 4) << refused.err;
  EXPECT_NE(refused.err.find("collinear"), std::string::npos) << refused.err;
}

TEST(Print, MakesAPdfPageOfTheBoardsSize) {
  const TemporaryFolder folder;
  const std::string out = folder.file("board.pdf");
  ASSERT_EQ(run_alea({"print", "checkerboard", "--side", "0.2", out}).exit_code, 0);
  const std::string pdf = testing::read_text(out);
  EXPECT_TRUE(pdf.starts_with("%PDF-1."));
  // 0.2 m and two margins of 0.05 m are 0.3 m: 850.394 points.
  EXPECT_NE(pdf.find("/MediaBox [0 0 850.393701 850.393701]"), std::string::npos);
  ASSERT_EQ(run_alea({"print", "pips", "--side", "0.1", folder.file("pips.pdf")}).exit_code, 0);
  EXPECT_NE(testing::read_text(folder.file("pips.pdf")).find("/Count 6"), std::string::npos);
  EXPECT_EQ(run_alea({"print", "checkerboard", "--side", "0", out}).exit_code, 2);
  EXPECT_EQ(run_alea({"print", "checkerboard", "--side", "0.2", "/nowhere/x.pdf"}).exit_code, 3);
}

}  // namespace
}  // namespace alea
