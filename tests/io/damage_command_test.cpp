#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace alea {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::run_shell;
using testing::TemporaryFolder;

const std::string quoted_program = "'" + testing::program_path() + "'";

// Runs a line of sh with a file system of its own in `mount`, which nobody else sees; empty where
// the system does not let us have one.
std::optional<testing::ShellRun> with_own_mount(const std::string& mount, const std::string& line) {
  const std::string probe = "unshare -m mount -t tmpfs -o size=64k none '" + mount + "'";
  if (run_shell(probe).exit_code != 0) return std::nullopt;
  return run_shell("unshare -m sh -c \"mount -t tmpfs -o size=64k none '" + mount + "' && " + line +
                   "\"");
}

constexpr const char* no_mount = "a file system of one's own needs root and unshare";

TEST(DamageCommand, AFullFileSystemLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  const std::string mount = folder.file("small");
  fs::create_directory(mount);
  write_cloud(folder.file("in.ply"), testing::full_cloud(20000, false));
  for (const std::string name : {"out.ply", "out.pcd", "out.xyz", "out.ptx", "out.e57"}) {
    const std::string out = mount + "/" + name;
    const auto run =
        with_own_mount(mount, "printf old > '" + out + "'; " + quoted_program + " convert '" +
                                  folder.file("in.ply") + "' '" + out + "'; echo exit \\$?; cat '" +
                                  out + "'; ls '" + mount + "'");
    if (!run) GTEST_SKIP() << no_mount;
    EXPECT_THAT(run->output, HasSubstr(name + ": cannot write: No space left on device"));
    EXPECT_THAT(run->output, HasSubstr("exit 3\nold" + name + "\n"))
        << "the old file, and no other";
  }
}

TEST(DamageCommand, AReadOnlyFileSystemIsNamed) {
  const TemporaryFolder folder;
  const std::string mount = folder.file("fixed");
  fs::create_directory(mount);
  write_cloud(folder.file("in.ply"), testing::full_cloud(10, false));
  const auto run = with_own_mount(mount, "mount -o remount,ro '" + mount + "' && " +
                                             quoted_program + " convert '" + folder.file("in.ply") +
                                             "' '" + mount + "/out.ply'; echo exit \\$?");
  if (!run) GTEST_SKIP() << no_mount;
  EXPECT_THAT(run->output, HasSubstr("out.ply: cannot write: Read-only file system"));
  EXPECT_THAT(run->output, HasSubstr("exit 3"));
}

TEST(DamageCommand, AFolderThatCannotBeOneIsNamed) {
  const TemporaryFolder folder;
  write_cloud(folder.file("in.ply"), testing::full_cloud(10, false));
  for (const std::string out : {"in.ply/out.ply", "missing/out.e57", "."}) {
    const testing::ProgramRun run =
        testing::run_alea({"convert", folder.file("in.ply"), folder.path().string() + "/" + out});
    EXPECT_EQ(run.exit_code, 3) << out;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

// A child that reads a large text file: true once the file is mapped, false if the child ended
// before.
bool waits_until_mapped(pid_t child, const std::string& path) {
  while (::waitpid(child, nullptr, WNOHANG) == 0) {
    if (testing::read_text("/proc/" + std::to_string(child) + "/maps").find(path) !=
        std::string::npos)
      return true;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return false;
}

class Reading : public ::testing::Test {
 protected:
  // Starts `alea convert in.xyz out.ply` on some 20 MB of text.
  pid_t start() {
    std::string line, text;
    for (int i = 0; i < 1000; ++i) line += std::to_string(i) + ".125 2.25 3.375\n";
    for (int i = 0; i < 1000; ++i) text += line;
    write_file_atomically(in_, text);
    write_file_atomically(out_, "old");
    const std::string command = "exec " + quoted_program + " convert '" + in_ + "' '" + out_ +
                                "' 2> '" + folder_.file("message") + "'";
    const char* const arguments[] = {"sh", "-c", command.c_str(), nullptr};
    pid_t child = 0;
    EXPECT_EQ(::posix_spawn(&child, "/bin/sh", nullptr, nullptr,
                            const_cast<char* const*>(arguments), environ),
              0);
    return child;
  }
  int end_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  TemporaryFolder folder_;
  const std::string in_ = folder_.file("in.xyz");
  const std::string out_ = folder_.file("out.ply");
};

TEST_F(Reading, AFileCutShortMeanwhileIsOneLineAndTheOldFileStays) {
  const pid_t child = start();
  if (!waits_until_mapped(child, in_)) GTEST_SKIP() << "read before it could be cut";
  fs::resize_file(in_, 100);
  EXPECT_EQ(end_of(child), 3);
  const std::string message = testing::read_text(folder_.file("message"));
  EXPECT_THAT(message, HasSubstr("in.xyz"));
  EXPECT_THAT(message, ::testing::AnyOf(HasSubstr("became shorter"),
                                        HasSubstr("changed while it was read")));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  EXPECT_EQ(testing::read_text(out_), "old");
}

TEST_F(Reading, AFileRemovedMeanwhileIsReadToItsEnd) {
  const pid_t child = start();
  if (!waits_until_mapped(child, in_)) GTEST_SKIP() << "read before it could be removed";
  fs::remove(in_);
  EXPECT_EQ(end_of(child), 0) << testing::read_text(folder_.file("message"));
  EXPECT_EQ(read_cloud(out_).size(), 1000000u);
}

}  // namespace
}  // namespace alea
