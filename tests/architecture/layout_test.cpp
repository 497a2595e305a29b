#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/paths.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path root = alea::testing::source_dir();

const std::set<std::string> source_folders{"lib",     "experiments", "tests", "datasets",
                                           "scripts", "paper",       ".ci"};
// Made by tools and ignored by git.
const std::set<std::string> generated_folders{".git", "build", "out", ".cache", ".vscode", ".idea"};

std::vector<fs::path> source_files() {
  std::vector<fs::path> files;
  for (const auto& top : fs::directory_iterator(root)) {
    if (top.is_regular_file()) files.push_back(top.path());
    if (!source_folders.contains(top.path().filename())) continue;
    for (const auto& entry : fs::recursive_directory_iterator(top.path()))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  return files;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(Layout, TheTopLevelHasOnlyTheFoldersOfTheDesign) {
  for (const auto& entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename();
    if (!entry.is_directory() || generated_folders.contains(name)) continue;
    EXPECT_TRUE(source_folders.contains(name))
        << name << "/: a method's page goes to its folder in lib/alea, benchmarks to experiments";
  }
}

TEST(Layout, TheFirstFilesOfAProjectAreThere) {
  for (const char* name : {"README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md", ".ci/run",
                           "scripts/test", "scripts/reproduce", "scripts/packages.txt"})
    EXPECT_TRUE(fs::exists(root / name)) << name;
}

TEST(Layout, NoFileNamesAPackageRegistry) {
  const std::vector<std::pair<std::string, std::string>> hosts{
      {"pypi", "org"},        {"pythonhosted", "org"}, {"npmjs", "org"},
      {"npmjs", "com"},       {"crates", "io"},        {"anaconda", "org"},
      {"rubygems", "org"},    {"deb.debian", "org"},   {"snapshot.debian", "org"},
      {"proxy.golang", "org"}};
  for (const fs::path& file : source_files()) {
    const std::string text = contents(file);
    for (const auto& [name, domain] : hosts)
      EXPECT_EQ(text.find(name + "." + domain), std::string::npos)
          << file << " names " << name << "." << domain;
  }
}

TEST(Layout, BashScriptsStopAtTheFirstError) {
  for (const std::string folder : {"scripts", ".ci"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string text = entry.is_regular_file() ? contents(entry.path()) : "";
      if (!text.starts_with("#!/usr/bin/env bash")) continue;
      EXPECT_NE(text.find("set -euo pipefail"), std::string::npos) << entry.path();
      const auto execute = fs::perms::owner_exec;
      EXPECT_EQ(entry.status().permissions() & execute, execute) << entry.path();
    }
  }
}

}  // namespace
