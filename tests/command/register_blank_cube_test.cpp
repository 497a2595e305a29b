#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "alea/io/cloud_file.hpp"
#include "tests/support/die_scenes.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using testing::ProgramRun;

/// Two scans of a blank cube in a room, as files.
class RegisterBlankCubeCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::TwoStationCase room{.range_m = 3, .step_rad = 4e-3, .walls = true};
    room.change_die = [](DieModel& model, int) { model.pips.painted = false; };
    const testing::TwoScans scans = testing::scan_twice(room);
    write_cloud(folder_.file("master.ply"), scans.master);
    write_cloud(folder_.file("slave.ply"), scans.slave);
  }
  ProgramRun run(const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"register",
                                       "die",
                                       folder_.file("master.ply"),
                                       folder_.file("slave.ply"),
                                       "--edge",
                                       "0.5",
                                       "--quiet",
                                       "--json",
                                       folder_.file("out.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return testing::run_alea(arguments);
  }
  json result() const { return json::parse(testing::read_text(folder_.path() / "out.json")); }

  testing::TemporaryFolder folder_;
};

TEST_F(RegisterBlankCubeCommand, ListsWhatLevelledScannersLeaveAndSaysWhatToDo) {
  const ProgramRun ran = run({"--levelled"});
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_NE(ran.err.find("4 orientations of the die remain for levelled scanners; --resolve scene"),
            std::string::npos)
      << ran.err;
  const json refused = result();
  EXPECT_TRUE(testing::schema_violations(refused, testing::load_schema("register.v1")).empty());
  EXPECT_EQ(refused["ambiguity"]["alternatives"], 3);
  EXPECT_EQ(refused["ambiguity"]["orientations"].size(), 4u);
}

TEST_F(RegisterBlankCubeCommand, IsRegisteredByTheSceneWhenAsked) {
  const ProgramRun ran = run({"--resolve", "scene"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.err.find("resolved_by_scene"), std::string::npos);
  const json registered = result();
  const auto violations =
      testing::schema_violations(registered, testing::load_schema("register.v1"));
  EXPECT_TRUE(violations.empty()) << violations[0];
  EXPECT_EQ(registered["ambiguity"]["resolved_by"], "scene");
  EXPECT_EQ(registered["ambiguity"]["orientations"].size(), 24u);
}

TEST_F(RegisterBlankCubeCommand, KnowsNoOtherWayToResolve) {
  EXPECT_EQ(run({"--resolve", "guess"}).exit_code, 2);
}

}  // namespace
}  // namespace alea
