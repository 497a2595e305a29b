#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace {

using alea::testing::run_shell;
using alea::testing::ShellRun;

// Installs this build once and builds a program of ten lines against what was installed.
TEST(Package, AConsumerBuildsAndRunsAgainstTheInstalledLibrary) {
  const std::string build =
      std::filesystem::path(alea::testing::program_path()).parent_path().parent_path();
  const std::string source = alea::testing::source_dir() + "/tests/package/consumer";
  const alea::testing::TemporaryFolder folder;
  const std::string prefix = folder.file("prefix"), binary = folder.file("consumer");

  const ShellRun install = run_shell("cmake --install '" + build + "' --prefix '" + prefix + "'");
  ASSERT_EQ(install.exit_code, 0) << install.output;
  const ShellRun configure =
      run_shell("cmake -G Ninja -S '" + source + "' -B '" + binary + "' -DCMAKE_PREFIX_PATH='" +
                prefix + "' -DCMAKE_BUILD_TYPE=Release && cmake --build '" + binary + "'");
  ASSERT_EQ(configure.exit_code, 0) << configure.output;
  const ShellRun consumer = run_shell("'" + binary + "/consumer'");
  EXPECT_EQ(consumer.exit_code, 0) << consumer.output;
  EXPECT_TRUE(consumer.output.starts_with("alea ")) << consumer.output;
  const ShellRun program = run_shell("'" + prefix + "/bin/alea' --version");
  EXPECT_EQ(program.exit_code, 0) << program.output;
  EXPECT_TRUE(program.output.starts_with("alea ")) << program.output;
}

TEST(Package, NoInstalledHeaderIncludesCgalOrOpencv) {
  const std::string build =
      std::filesystem::path(alea::testing::program_path()).parent_path().parent_path();
  const alea::testing::TemporaryFolder folder;
  const std::string prefix = folder.file("prefix");
  const ShellRun install = run_shell("cmake --install '" + build + "' --prefix '" + prefix + "'");
  ASSERT_EQ(install.exit_code, 0) << install.output;
  const ShellRun grep = run_shell("grep -rlE 'include <(CGAL|opencv2)/' '" + prefix + "/include'");
  EXPECT_EQ(grep.exit_code, 1) << grep.output;
}

}  // namespace
