#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace alea {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::run_alea;
using testing::run_shell;

// What users do with the program that nobody planned.
class OddCommand : public ::testing::Test {
 protected:
  OddCommand() { write_file_atomically(in_, "1 2 3\n4 5 6\n"); }
  // Exit code and one line that names what is wrong.
  void expect_refused(const std::vector<std::string>& arguments, int exit_code,
                      const std::string& word) {
    const testing::ProgramRun run = run_alea(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_THAT(run.err, HasSubstr(word));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  testing::TemporaryFolder folder_;
  const std::string in_ = folder_.file("in.xyz");
  const std::string out_ = folder_.file("out.ply");
  const std::string program_ = "'" + testing::program_path() + "'";
};

TEST_F(OddCommand, ScanNumbersThatAreNone) {
  for (const char* mark : {"#0", "#x", "#", "#-1", "#99"})
    expect_refused({"info", in_ + mark}, 3, "in.xyz: ");
  expect_refused({"info", in_ + "#0"}, 3, "'#0' is not the number of a scan");
  expect_refused({"info", folder_.file("none.e57#2")}, 3, "none.e57: cannot read: No such file");
}

TEST_F(OddCommand, ColumnsThatMakeNoScanAreWrongUsage) {
  expect_refused({"info", in_, "--columns", "a,b,c"}, 2, "--columns: no x, y and z");
  expect_refused({"info", in_, "--columns", "x,y,z,x"}, 2, "'x' has been named before");
  expect_refused({"info", in_, "--columns", "x,,z"}, 2, "an empty value");
}

TEST_F(OddCommand, TheResultDoesNotReplaceTheScan) {
  expect_refused({"info", in_, "--json", folder_.path().string() + "/./in.xyz"}, 2,
                 "is the scan itself");
  EXPECT_EQ(testing::read_text(in_), "1 2 3\n4 5 6\n");
}

TEST_F(OddCommand, APoseThatIsNotRigidIsJoinedToNoRegistration) {
  write_file_atomically(folder_.file("t.txt"), "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n");
  write_file_atomically(folder_.file("a.ptx"),
                        "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0.5 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
                        "1 2 3 0.5\n");
  for (const char* name : {"o.ply", "o.e57", "o.ptx"})
    expect_refused({"apply", folder_.file("t.txt"), folder_.file("a.ptx"), folder_.file(name)}, 3,
                   "a.ptx: the pose of scan 1 is not rigid");
  expect_refused({"merge", folder_.file("a.ptx"), in_, "--out", out_}, 3,
                 "a.ptx: the pose of scan 1 is not rigid");
  expect_refused({"convert", folder_.file("a.ptx"), folder_.file("o.e57")}, 3, "o.e57: the pose");
  EXPECT_FALSE(fs::exists(out_) || fs::exists(folder_.file("o.e57")));
}

TEST_F(OddCommand, AScanOfNoPointsIsGoodForInfoAndBadForRegistration) {
  const std::string none = folder_.file("none.csv");
  write_file_atomically(none, "x,y,z,intensity\n");
  write_file_atomically(folder_.file("t.txt"), "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n");
  EXPECT_EQ(run_alea({"info", none}).exit_code, 0);
  EXPECT_EQ(run_alea({"convert", none, out_}).exit_code, 0);
  EXPECT_EQ(read_cloud(out_).size(), 0u);
  const std::vector<std::vector<std::string>> commands{
      {"register", "die", none, none, "--edge", "0.5"},
      {"register", "spheres", none, none, "--radius", "0.1"},
      {"register", "markerless", none, none},
      {"register", "checkerboards", none, none, "--side", "0.5"},
      {"register", "network", none, none},
      {"measure", "checkerboard", none, "--side", "0.5"},
      {"evaluate", none, none, "--transform", folder_.file("t.txt")}};
  for (const std::vector<std::string>& command : commands) expect_refused(command, 3, "none.csv: ");
}

TEST_F(OddCommand, NumbersOutOfRangeAndFoldersForFiles) {
  for (const char* number : {"0", "-1", "1.5", "abc", "99999999999"})
    expect_refused({"info", in_, "--decimate", number}, 2, "--decimate");
  expect_refused({"apply", folder_.path().string(), in_, out_}, 3, "a folder; expected a file");
}

TEST_F(OddCommand, WhatIsNoFileIsNotRead) {
  ASSERT_EQ(::mkfifo(folder_.file("pipe.xyz").c_str(), 0600), 0);
  for (const std::string& path : {folder_.file("pipe.xyz"), folder_.path().string(),
                                  std::string("/dev/null"), std::string("/dev/zero")})
    expect_refused({"info", path}, 3, path + ": not a regular file");
}

TEST_F(OddCommand, ControlCharactersOfAFileDoNotReachTheTerminal) {
  write_file_atomically(in_, "1 2 3\n4 5 \x1b[2J\x7f\n");
  expect_refused({"info", in_}, 3, "line 2: '?[2J?' is not a number");
}

TEST_F(OddCommand, TheSameFileInAndOut) {
  ASSERT_EQ(run_alea({"convert", in_, in_}).exit_code, 0);
  EXPECT_EQ(read_cloud(in_).positions, (std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}}));
}

// Renaming a temporary file onto /dev/null would replace the device.
TEST_F(OddCommand, DevicesAndPipesAreWrittenAndNotReplaced) {
  EXPECT_EQ(run_alea({"info", in_, "--json", "/dev/null"}).exit_code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const testing::ProgramRun run = run_alea({"info", in_, "--json", "/dev/stdout"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("\"points\": 2"));
  const std::string pipe = folder_.file("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(run_shell("cat '" + pipe + "' > '" + out_ + "' & " + program_ + " convert '" + in_ +
                      "' '" + pipe + "'; wait")
                .exit_code,
            0);
  EXPECT_EQ(read_cloud(out_).size(), 2u);
  expect_refused({"convert", in_, folder_.file("out.xyz/")}, 3, "out.xyz/");
}

TEST_F(OddCommand, AReplacedFileKeepsItsPermissionsAndItsLink) {
  write_file_atomically(out_, "old");
  fs::permissions(out_, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(out_, folder_.file("link.ply"));
  ASSERT_EQ(run_alea({"convert", in_, folder_.file("link.ply")}).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_.file("link.ply")));
  EXPECT_EQ(fs::status(out_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(read_cloud(out_).size(), 2u);
}

TEST_F(OddCommand, AStandardOutputThatTakesNothingIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  write_file_atomically(folder_.file("t.txt"), "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n");
  for (const std::string line :
       {" info '" + in_ + "'", " info '" + in_ + "' --json -",
        " transform '" + folder_.file("t.txt") + "'", std::string(" --help")}) {
    const testing::ShellRun run = run_shell(program_ + line + " 2>&1 > /dev/full; echo exit $?");
    EXPECT_THAT(run.output, HasSubstr("standard output: cannot write")) << line;
    EXPECT_THAT(run.output, HasSubstr("exit 3")) << line;
  }
}

}  // namespace
}  // namespace alea
