#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/fuzz/fuzz_one.hpp"
#include "tests/support/paths.hpp"

namespace alea {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

const fs::path corpus = fs::path(testing::source_dir()) / "tests/fuzz/corpus";

TEST(FuzzCorpus, EverySeedAndEveryFindingIsReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(corpus)) {
    if (!entry.is_regular_file()) continue;
    const bool readable =
        testing::read_as(entry.path().parent_path().filename().string(), contents(entry.path()));
    if (entry.path().filename().string().starts_with("seed")) {
      EXPECT_TRUE(readable) << entry.path();
    }
    ++files;
  }
  EXPECT_GE(files, 7u);
}

// What a fuzzer does first, without one: every seed cut short at, and changed in, every byte.
TEST(FuzzCorpus, CutAndChangedSeedsNeitherCrashNorHang) {
  for (const auto& entry : fs::recursive_directory_iterator(corpus)) {
    if (!entry.is_regular_file()) continue;
    const std::string format = entry.path().parent_path().filename().string();
    const std::string whole = contents(entry.path());
    const std::size_t step = 1 + whole.size() / 150;
    for (std::size_t at = 0; at < whole.size(); at += step) {
      testing::read_as(format, whole.substr(0, at));
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ (at % 2 == 0 ? 0xFF : 0x01));
      testing::read_as(format, changed);
    }
  }
}

}  // namespace
}  // namespace alea
