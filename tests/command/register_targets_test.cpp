#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/command/json_matrix.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::ProgramRun;
using testing::read_text;
using testing::run_alea;
using testing::TemporaryFolder;

void expect_conforming(const json& value) {
  const auto violations = testing::schema_violations(value, testing::load_schema("register.v1"));
  EXPECT_TRUE(violations.empty()) << std::accumulate(violations.begin(), violations.end(),
                                                     std::string());
}

/// A simulated scene with two stations, and registrations of it.
class Simulated {
 public:
  explicit Simulated(const std::string& objects) {
    std::ofstream(folder.file("scene.toml"))
        << objects
        << "[[station]]\nname = \"master\"\nposition_m = [5, 0.5, 1.6]\n"
           "omega_phi_kappa_deg = [0, 0, 170]\nazimuth_deg = [-50, 60]\n"
           "elevation_deg = [-30, 15]\nstep_mrad = 4\n"
           "[[station]]\nname = \"slave\"\nposition_m = [0.5, -5, 1.5]\n"
           "omega_phi_kappa_deg = [0, 0, 85]\nazimuth_deg = [-60, 50]\n"
           "elevation_deg = [-30, 15]\nstep_mrad = 4\n";
    const ProgramRun run = run_alea(
        {"simulate", folder.file("scene.toml"), "--out", folder.path().string(), "--quiet"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
  ProgramRun registered_by(const std::string& target, std::vector<std::string> options) const {
    std::vector<std::string> arguments{"register", target, folder.file("master.ply"),
                                       folder.file("slave.ply"), "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_alea(arguments);
  }
  Eigen::Matrix4d truth() const {
    const json scans = json::parse(read_text(folder.file("truth.json")))["scans"];
    return matrix_of(scans[0]["scene_from_scan"]).inverse() *
           matrix_of(scans[1]["scene_from_scan"]);
  }

  TemporaryFolder folder;
};

std::string sphere(double x, double y, double z) {
  return "[[sphere]]\nradius_m = 0.1\ncentre_m = [" + std::to_string(x) + ", " + std::to_string(y) +
         ", " + std::to_string(z) + "]\n";
}

const Simulated& four_spheres() {
  static const Simulated scene(sphere(0, 0, 1) + sphere(1.2, 0.3, 1.8) + sphere(-0.4, 1.1, 0.6) +
                               sphere(0.5, -0.9, 1.4));
  return scene;
}

TEST(RegisterSpheresCommand, WritesJsonThatConformsAndIsRight) {
  const ProgramRun run =
      four_spheres().registered_by("spheres", {"--radius", "0.1", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  expect_conforming(result);
  EXPECT_EQ(result["status"], "registered");
  EXPECT_EQ(result["spheres"].size(), 4u);
  EXPECT_FALSE(result["master_from_slave"]["covariance"].is_null());
  EXPECT_LT((matrix_of(result["master_from_slave"]["matrix"]) - four_spheres().truth())
                .cwiseAbs()
                .maxCoeff(),
            0.01);
}

TEST(RegisterSpheresCommand, CentresOnALineAreRefusedAsCollinear) {
  const Simulated line(sphere(0, 0, 1) + sphere(0.7, 0.7, 1) + sphere(-0.9, -0.9, 1));
  const ProgramRun run = line.registered_by("spheres", {"--radius", "0.1", "--json", "-"});
  EXPECT_EQ(run.exit_code, 4) << run.err;
  const json result = json::parse(run.out);
  expect_conforming(result);
  EXPECT_EQ(result["refusal"]["code"], "collinear");
  EXPECT_TRUE(result["master_from_slave"].is_null());
}

TEST(RegisterSpheresCommand, NoSphereOfThatSizeIsRefused) {
  const ProgramRun run = four_spheres().registered_by("spheres", {"--radius", "0.6"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_THAT(run.err, HasSubstr("refused ("));
}

TEST(RegisterSpheresCommand, BadInputHasItsExitCodeAndOneLine) {
  const auto line_count = [](const ProgramRun& run) {
    return std::count(run.err.begin(), run.err.end(), '\n');
  };
  const ProgramRun absurd = four_spheres().registered_by("spheres", {"--radius", "-1"});
  EXPECT_EQ(absurd.exit_code, 2);
  EXPECT_THAT(absurd.err, HasSubstr("--radius"));
  const ProgramRun unwritable = four_spheres().registered_by(
      "spheres", {"--radius", "0.1", "--json", four_spheres().folder.file("none/out.json")});
  EXPECT_EQ(unwritable.exit_code, 3);
  EXPECT_EQ(line_count(unwritable), 1) << unwritable.err;
  const ProgramRun missing =
      run_alea({"register", "spheres", "/nonexistent.ply", "/nonexistent.ply", "--radius", "0.1"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_EQ(line_count(missing), 1) << missing.err;
}

/// A corner of a hall with a slanted board: planes enough without any target.
const Simulated& hall() {
  const auto patch = [](const char* corner, const char* u, const char* v) {
    return std::string("[[patch]]\ncorner_m = ") + corner + "\nside_u_m = " + u +
           "\nside_v_m = " + v + "\n";
  };
  static const Simulated scene(patch("[-3, -3, 0]", "[9, 0, 0]", "[0, 9, 0]") +
                               patch("[-3, -3, 0]", "[0, 9, 0]", "[0, 0, 3]") +
                               patch("[-3, 4, 0]", "[9, 0, 0]", "[0, 0, 3]") +
                               patch("[-2.5, 1, 0]", "[1.5, 1, 0]", "[0, 0, 2]"));
  return scene;
}

TEST(RegisterPlanesCommand, WritesJsonThatConformsAndIsRight) {
  const ProgramRun run = hall().registered_by("planes", {"--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  expect_conforming(result);
  EXPECT_EQ(result["method"], "planes");
  EXPECT_LT(
      (matrix_of(result["master_from_slave"]["matrix"]) - hall().truth()).cwiseAbs().maxCoeff(),
      0.01);
  // Its own output is an initial transform, from which it comes to the same answer.
  std::ofstream(hall().folder.file("first.json")) << run.out;
  const ProgramRun again = hall().registered_by(
      "planes", {"--initial", hall().folder.file("first.json"), "--json", "-"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_LT((matrix_of(json::parse(again.out)["master_from_slave"]["matrix"]) -
             matrix_of(result["master_from_slave"]["matrix"]))
                .cwiseAbs()
                .maxCoeff(),
            1e-5);
}

TEST(RegisterPlanesCommand, AnInitialTransformFarOffIsRefused) {
  std::ofstream(hall().folder.file("identity.txt")) << "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n";
  const ProgramRun run =
      hall().registered_by("planes", {"--initial", hall().folder.file("identity.txt")});
  EXPECT_EQ(run.exit_code, 4) << run.err;
}

TEST(RegisterPlanesCommand, BadInputHasItsExitCode) {
  EXPECT_EQ(hall().registered_by("planes", {"--initial", "/nonexistent.txt"}).exit_code, 3);
  EXPECT_EQ(hall().registered_by("planes", {"--check-planes", "/nonexistent.txt"}).exit_code, 3);
  EXPECT_EQ(hall().registered_by("planes", {"--planes", "magic"}).exit_code, 2);
  std::ofstream(hall().folder.file("far.txt")) << "100 100 100\n";
  const ProgramRun far =
      hall().registered_by("planes", {"--check-planes", hall().folder.file("far.txt")});
  EXPECT_EQ(far.exit_code, 3);
  EXPECT_THAT(far.err, HasSubstr("no plane that both scans see is near"));
}

}  // namespace
}  // namespace alea
