#include "alea/simulate/scene_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/io/cloud_file.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using testing::read_text;
using testing::run_alea;
using testing::TemporaryFolder;

const std::string minimal =
    "[[die]]\nedge_m = 0.5\ncentre_m = [0, 0, 0.25]\n"
    "[[station]]\nposition_m = [3, 3, 1.6]\naim_at = \"die\"\n"
    "step_mrad = 4\n";

std::string message_of(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("scene.toml")) << text;
  try {
    load_scene(folder.file("scene.toml"));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "no error";
}

TEST(SceneFile, ErrorsNameFileLineAndExpectation) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_EQ(message_of(minimal), "no error");
  EXPECT_THAT(message_of(minimal + "colour = 3\n"),
              AllOf(HasSubstr("scene.toml:8"), HasSubstr("unknown key 'colour'")));
  EXPECT_THAT(message_of("[[die]]\nedge_m = -0.5\n"),
              AllOf(HasSubstr("scene.toml:2"), HasSubstr("die.edge_m = -0.5"),
                    HasSubstr("a positive number")));
  EXPECT_THAT(message_of("[[die]]\nedge_m = \"large\"\n"), HasSubstr("a positive number"));
  EXPECT_THAT(message_of("[[die]]\ncentre_m = [0, 0]\n"), HasSubstr("three finite numbers"));
  EXPECT_THAT(message_of("[[die]]\n"), HasSubstr("'centre_m', which is missing"));
  EXPECT_THAT(message_of("[[die]]\ncentre_m = [0,0,0]\n[[die.facet]]\npips = 1\n"
                         "tilt_u_deg = 80\n"),
              HasSubstr("a closed convex body"));
  EXPECT_THAT(message_of("[[sphere]]\ncentre_m = [0,0,0]\n"),
              HasSubstr("at least one [[station]]"));
  EXPECT_THAT(message_of("die = 3\n"), HasSubstr("tables [[die]]"));
  EXPECT_THAT(message_of("[[die\n"), HasSubstr("not TOML"));
}

TEST(SceneFile, EverySceneOfTheProjectLoads) {
  int scenes = 0;
  const auto root = std::filesystem::path(testing::source_dir()) / "datasets";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    // manifest.toml lists public data sets; every other TOML is a scene.
    if (entry.path().extension() != ".toml" || entry.path().filename() == "manifest.toml") continue;
    EXPECT_GE(load_scene(entry.path()).stations.size(), 2u) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 3);
}

TEST(Simulate, WrittenPointsLieOnThePlanesOfTheWrittenTruth) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("scene.toml"))
      << "[scanner]\nrange_noise_m = 0\ngrazing_m = 0\nsurface_m = 0\nangular_noise_arcsec = 0\n"
      << minimal;
  const auto run =
      run_alea({"simulate", folder.file("scene.toml"), "--out", folder.file("out"), "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto truth = nlohmann::json::parse(read_text(folder.path() / "out/truth.json"));
  const auto& scan = truth["scans"][0];
  const Cloud cloud =
      read_cloud((folder.path() / "out" / scan["file"].get<std::string>()).string());
  ASSERT_EQ(cloud.size(), scan["points"].get<std::size_t>());
  ASSERT_GT(cloud.size(), 500u);
  for (const Eigen::Vector3d& p : cloud.positions) {
    Eigen::Vector3d q;
    for (int r = 0; r < 3; ++r) {
      const auto& row = scan["scene_from_scan"][r];
      q[r] = row[0].get<double>() * p[0] + row[1].get<double>() * p[1] +
             row[2].get<double>() * p[2] + row[3].get<double>();
    }
    double nearest = 1;
    for (const auto& [pips, plane] : truth["die"]["planes"].items()) {
      const auto& n = plane["normal"];
      const double distance = n[0].get<double>() * q[0] + n[1].get<double>() * q[1] +
                              n[2].get<double>() * q[2] - plane["offset_m"].get<double>();
      nearest = std::min(nearest, std::abs(distance));
    }
    EXPECT_LT(nearest, 1e-9);
  }
}

TEST(Simulate, BadSceneIsExitThreeWithOneLineAndNoFolder) {
  const TemporaryFolder folder;
  const auto run = run_alea({"simulate", folder.file("none.toml"), "--out", folder.file("out")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace alea
