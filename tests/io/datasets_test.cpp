#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace alea {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::run_shell;
using testing::TemporaryFolder;

const std::string get_datasets = "'" + testing::source_dir() + "/scripts/get-datasets'";

// A data set of two files in a folder that stands for the network; the sum of the second is wrong.
TEST(Datasets, FilesAreDownloadedAndOneWithAWrongSumIsNotKept) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "origin/raw/v1/data");
  std::ofstream(folder.path() / "origin/raw/v1/data/a.xyz") << "1 2 3\n";
  std::ofstream(folder.path() / "origin/raw/v1/data/b b.xyz") << "4 5 6\n";
  const std::string sum =
      run_shell("printf '1 2 3\\n' | sha256sum | cut -c1-64").output.substr(0, 64);
  std::ofstream(folder.file("manifest.toml"))
      << "[[dataset]]\nname = \"small\"\norigin = \"file://" << folder.path().string()
      << "/origin\"\ncommit = \"v1\"\nfolder = \"data\"\nlicence = \"CC0-1.0\"\nfiles = [\n"
      << "{name = \"one/a.xyz\", source = \"a.xyz\", sha256 = \"" << sum << "\"},\n"
      << "{name = \"b b.xyz\", sha256 = \"" << sum << "\"},\n]\n";
  const std::string arguments =
      " --manifest '" + folder.file("manifest.toml") + "' '" + folder.file("data") + "'";
  const testing::ShellRun run = run_shell(get_datasets + arguments);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("a.xyz: downloaded and verified"));
  EXPECT_THAT(run.output, HasSubstr("its SHA-256 is not the one in the manifest"));
  EXPECT_EQ(testing::read_text(folder.path() / "data/small/one/a.xyz"), "1 2 3\n");
  EXPECT_EQ(run_shell("ls '" + folder.file("data/small") + "'").output, "one\n");
  EXPECT_THAT(run_shell(get_datasets + " --check" + arguments).output,
              HasSubstr("b b.xyz: missing"));
}

TEST(Datasets, WithoutANetworkOneLineNamesTheHost) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("manifest.toml"))
      << "[[dataset]]\nname = \"far\"\norigin = \"http://127.0.0.1:1/origin\"\ncommit = \"v1\"\n"
      << "folder = \"\"\nlicence = \"CC0-1.0\"\nfiles = [\n{name = \"a.xyz\", sha256 = \"0\"},\n"
      << "{name = \"b.xyz\", sha256 = \"0\"},\n]\n";
  const testing::ShellRun run =
      run_shell("http_proxy= " + get_datasets + " --manifest '" + folder.file("manifest.toml") +
                "' '" + folder.file("data") + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("127.0.0.1:1: "));
  EXPECT_THAT(run.output, HasSubstr("is there a network?"));
  EXPECT_THAT(run.output, HasSubstr("2 are missing or wrong"));
  EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 2) << run.output;
}

TEST(Datasets, WhatIsThereIsWhatTheManifestSays) {
  const char* datasets = std::getenv("ALEA_DATASETS");
  if (datasets == nullptr) GTEST_SKIP() << "set ALEA_DATASETS to a folder of scripts/get-datasets";
  const testing::ShellRun run = run_shell(get_datasets + " --check '" + datasets + "'");
  EXPECT_EQ(run.output.find("wrong SHA-256"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace alea
