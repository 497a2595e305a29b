#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "alea/io/cloud_file.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace alea {
namespace {

// Ctrl-C at any moment: exit code 130 (or done, where it came too late), and no file is cut short.
TEST(Simulate, AnInterruptLeavesNoHalfWrittenFile) {
  for (const std::string after_s : {"0.02", "0.1", "0.4", "1"}) {
    const testing::TemporaryFolder folder;
    std::ofstream scene(folder.file("scene.toml"));
    scene << "[[sphere]]\ncentre_m = [0, 0, 0]\nradius_m = 9\n";
    for (int i = 0; i < 12; ++i)
      scene << "[[station]]\nposition_m = [12, 0, 0]\nomega_phi_kappa_deg = [0, 0, 180]\n"
               "azimuth_deg = [-20, 20]\nelevation_deg = [-20, 20]\nstep_mrad = 1.5\n";
    scene.close();
    const testing::ShellRun run = testing::run_shell(
        "timeout --preserve-status -s INT " + after_s + " " + testing::program_path() +
        " simulate " + folder.file("scene.toml") + " --quiet --out " + folder.file("out"));
    EXPECT_TRUE(run.exit_code == 130 || run.exit_code == 0) << run.exit_code << run.output;
    if (!std::filesystem::exists(folder.path() / "out")) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out")) {
      const std::string extension = entry.path().extension();
      EXPECT_TRUE(extension == ".ply" || extension == ".json") << entry.path();
      if (extension == ".ply") {
        EXPECT_GT(read_cloud(entry.path().string()).size(), 1000u) << entry.path();
      }
    }
    if (run.exit_code == 130) {
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/truth.json"))
          << "the truth comes last";
    }
  }
}

}  // namespace
}  // namespace alea
