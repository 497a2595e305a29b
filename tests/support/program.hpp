#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace alea::testing {

struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built program `alea` with these arguments and waits for it.
ProgramRun run_alea(const std::vector<std::string>& arguments);

/// A folder of its own for one test, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);

}  // namespace alea::testing
