#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/json_schema.hpp"
#include "tests/support/program.hpp"

namespace {

using alea::testing::ProgramRun;
using alea::testing::run_alea;
using alea::testing::TemporaryFolder;
using nlohmann::json;

void expect_conforming(const json& value) {
  const auto violations =
      alea::testing::schema_violations(value, alea::testing::load_schema("noise.v1"));
  EXPECT_TRUE(violations.empty()) << violations.front();
}

/// One scan of an empty hall with the default noise.
std::string hall_scan(const TemporaryFolder& folder) {
  std::ofstream(folder.file("hall.toml"))
      << "[room]\ncorner_m = [0, 0, 0]\nsize_m = [24, 14, 5]\n"
         "[[station]]\nname = \"hall\"\nposition_m = [4, 4, 1.7]\nelevation_deg = [-50, 60]\n"
         "step_mrad = 8\n";
  const ProgramRun run =
      run_alea({"simulate", folder.file("hall.toml"), "--out", folder.path().string(), "--quiet"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return folder.file("hall.ply");
}

TEST(CalibrateNoiseCommand, WritesTheFileThatNoiseTakes) {
  const TemporaryFolder folder;
  const std::string scan = hall_scan(folder), noise = folder.file("noise.json"),
                    output = folder.file("output.json");
  const ProgramRun run =
      run_alea({"calibrate", "noise", scan, "--angular-arcsec", "5", "--range-growth-ppm", "0",
                "--surface-mm", "0.8", "--out", noise, "--json", output});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json document = json::parse(std::ifstream(output));
  expect_conforming(document);
  const json written = json::parse(std::ifstream(noise));
  EXPECT_EQ(written, document["noise"]);
  EXPECT_NEAR(written["range_noise_m"], 0.0013, 0.0001);
  EXPECT_NEAR(written["grazing_m"], 0.0008, 0.0001);
  // The round trip: a registration reads it. These are no scans of a die, so it is refused, not
  // wrong input.
  const ProgramRun taken =
      run_alea({"register", "die", scan, scan, "--edge", "0.5", "--noise", noise, "--quiet"});
  EXPECT_EQ(taken.exit_code, 4) << taken.err;
}

TEST(CalibrateNoiseCommand, RefusalsAndBadInputHaveTheirExitCodes) {
  const TemporaryFolder folder;
  std::ofstream points(folder.file("few.xyz"));
  for (int i = 0; i < 30; ++i) points << i % 6 << ' ' << i / 6 << " 2\n";
  points.close();
  const std::string output = folder.file("output.json");
  const ProgramRun refused =
      run_alea({"calibrate", "noise", folder.file("few.xyz"), "--json", output});
  EXPECT_EQ(refused.exit_code, 4) << refused.err;
  const json document = json::parse(std::ifstream(output));
  expect_conforming(document);
  EXPECT_EQ(document["status"], "refused");
  EXPECT_EQ(run_alea({"calibrate", "noise", folder.file("none.ply")}).exit_code, 3);
  EXPECT_EQ(run_alea({"calibrate", "noise"}).exit_code, 2);
  EXPECT_EQ(
      run_alea({"calibrate", "noise", folder.file("few.xyz"), "--surface-mm", "-1"}).exit_code, 2);
}

}  // namespace
