#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/support/paths.hpp"

namespace {

namespace fs = std::filesystem;

// Arrows run one way: a folder may include folders of lower rank and itself.
const std::map<std::string, int> rank_of_folder{
    {"core", 0},       {"cgal", 1},     {"io", 2},       {"cloud", 3},     {"transform", 4},
    {"plane", 5},      {"facet", 6},    {"die", 7},      {"sphere", 7},    {"checkerboard", 7},
    {"markerless", 7}, {"simulate", 8}, {"evaluate", 9}, {"pipeline", 10}, {"report", 11}};

std::vector<std::string> included_headers(const fs::path& file) {
  std::vector<std::string> headers;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#include")) continue;
    const auto from = line.find_first_of("<\"") + 1;
    headers.push_back(line.substr(from, line.find_first_of(">\"", from) - from));
  }
  return headers;
}

std::vector<fs::path> sources_below(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(alea::testing::source_dir()) / folder))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  return files;
}

TEST(IncludeRules, FoldersIncludeOnlyWhatLiesBelowThem) {
  const fs::path root = fs::path(alea::testing::source_dir()) / "lib/alea";
  for (const fs::path& file : sources_below("lib/alea")) {
    const fs::path relative = fs::relative(file, root);
    const std::string folder = relative.begin()->string();
    if (folder == "alea.hpp") continue;
    ASSERT_TRUE(rank_of_folder.contains(folder))
        << file << ": a folder without a place in the order";
    for (const std::string& header : included_headers(file)) {
      EXPECT_FALSE(header.starts_with("experiments/")) << file << " includes " << header;
      if (!header.starts_with("alea/")) continue;
      const std::string other = header.substr(5, header.find('/', 5) - 5);
      const bool below = other == folder || rank_of_folder.at(other) < rank_of_folder.at(folder);
      EXPECT_TRUE(below) << file << " includes " << header;
    }
  }
}

TEST(IncludeRules, HeavyHeadersStayInTheirSources) {
  for (const std::string top : {"lib/alea", "experiments", "tests"}) {
    for (const fs::path& file : sources_below(top)) {
      const std::string path = file.string();
      const bool is_header = file.extension() == ".hpp";
      const bool may_use_cgal = path.find("/lib/alea/cgal/") != std::string::npos ||
                                path.find("/experiments/exactness/") != std::string::npos ||
                                path.ends_with("_cgal.cpp") ||
                                path.find("/benchmarks/") != std::string::npos;
      for (const std::string& header : included_headers(file)) {
        const bool cgal_out_of_place = header.starts_with("CGAL/") && !may_use_cgal;
        const bool opencv_out_of_place = header.starts_with("opencv2/") && is_header;
        EXPECT_FALSE(cgal_out_of_place || opencv_out_of_place) << file << " includes " << header;
      }
    }
  }
}

TEST(IncludeRules, FilesFitASitting) {
  for (const std::string top : {"lib/alea", "experiments"}) {
    for (const fs::path& file : sources_below(top)) {
      std::ifstream in(file);
      std::size_t lines = 0;
      for (std::string line; std::getline(in, line);) ++lines;
      EXPECT_LE(lines, 330u) << file << ": split it by job";
    }
  }
}

}  // namespace
