#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/paths.hpp"

namespace {

namespace fs = std::filesystem;

struct FunctionSpan {
  std::string signature;
  std::size_t lines = 0;
};

// Functions at namespace level. The code is formatted, so one begins at the first column and ends
// with a line that is a closing brace alone.
std::vector<FunctionSpan> functions_of(std::istream& in) {
  std::vector<FunctionSpan> functions;
  std::string signature;
  std::size_t number = 0, first = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line == "}") {
      functions.push_back({signature, number - first + 1});
    } else if (!line.empty() && line.front() != ' ' && line.front() != '}' && line.front() != '#' &&
               !line.starts_with("//")) {
      signature = line;
      first = number;
    }
  }
  return functions;
}

TEST(FunctionSize, CountsFromTheSignatureToTheClosingBrace) {
  std::istringstream source("int a = 1;\n\nint f(int b,\n      int c) {\n  return b + c;\n}\n");
  const std::vector<FunctionSpan> functions = functions_of(source);
  ASSERT_EQ(functions.size(), 1u);
  EXPECT_EQ(functions[0].lines, 4u);
  EXPECT_EQ(functions[0].signature, "int f(int b,");
}

TEST(FunctionSize, NoFunctionIsLongerThanSixtyLines) {
  for (const std::string top : {"lib/alea", "experiments", "tests"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(alea::testing::source_dir()) / top)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      std::ifstream in(entry.path());
      for (const FunctionSpan& function : functions_of(in))
        EXPECT_LE(function.lines, 60u) << entry.path() << ": " << function.signature;
    }
  }
}

}  // namespace
