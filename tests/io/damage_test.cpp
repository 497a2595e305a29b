#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "alea/io/atomic_file.hpp"
#include "alea/io/input_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

namespace fs = std::filesystem;
using testing::full_cloud;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

// A limit on the size of a file stands for a full disk: the same failing write.
TEST(Damage, AFullDiskLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  write_cloud(folder.file("in.ply"), full_cloud(20000, false));
  for (const char* name : {"out.ply", "out.pcd", "out.xyz", "out.ptx", "out.e57"}) {
    write_file_atomically(folder.file(name), "old");
    const std::string command = "ulimit -f 64; '" + testing::program_path() + "' convert '" +
                                folder.file("in.ply") + "' '" + folder.file(name) + "' 2> '" +
                                folder.file("message") + "'";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3) << name;
    EXPECT_THAT(testing::read_text(folder.file("message")), HasSubstr(name));
    EXPECT_EQ(testing::read_text(folder.file(name)), "old");
    fs::remove(folder.file(name));
    fs::remove(folder.file("message"));
    EXPECT_EQ(files_in(folder.path()), 1u) << name;
  }
}

TEST(Damage, AFolderThatIsNotThereIsBadInput) {
  const TemporaryFolder folder;
  write_cloud(folder.file("in.ply"), full_cloud(3, false));
  const testing::ProgramRun run =
      testing::run_alea({"convert", folder.file("in.ply"), folder.file("no/out.ply")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("no/out.ply"));
}

TEST(Damage, AFileThatChangesItsSizeWhileItIsReadIsAnError) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("a.xyz"), "1 2 3\n4 5 6\n");
  const InputFile file(folder.file("a.xyz"));
  EXPECT_NO_THROW(file.check_unchanged());
  EXPECT_STREQ(mapped_path_of(file.bytes().data() + 3), folder.file("a.xyz").c_str());
  fs::resize_file(folder.file("a.xyz"), 6);
  EXPECT_THROW(file.check_unchanged(), Error);
}

bool has_unfinished(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().find(".part-") != std::string::npos) return true;
  return false;
}

TEST(Damage, AnInterruptWhileWritingLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  write_cloud(folder.file("in.ply"), full_cloud(200000, false));
  write_file_atomically(folder.file("out.xyz"), "old");
  const std::string in = folder.file("in.ply");
  const std::string out = folder.file("out.xyz");
  std::string program = testing::program_path();
  std::string convert = "convert";
  char* arguments[] = {program.data(), convert.data(), const_cast<char*>(in.c_str()),
                       const_cast<char*>(out.c_str()), nullptr};
  pid_t child = 0;
  ASSERT_EQ(::posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments, environ), 0);
  while (!has_unfinished(folder.path()) && ::waitpid(child, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(testing::read_text(out), "old");
  EXPECT_EQ(files_in(folder.path()), 2u);
}

}  // namespace
}  // namespace alea
