#include "experiments/engine/result_table.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "alea/core/error.hpp"
#include "experiments/engine/csv_table.hpp"
#include "tests/support/program.hpp"

namespace alea::experiments {
namespace {

ResultTable example() {
  ResultTable table{"table9", "An example, with a comma", "", {}};
  table.cells.push_back({"A-1", "union", "mm", "1.9", Interval{1.4, 1.5, 1.6}, Verdict::differs,
                         "a \"quoted\", 5 % note"});
  table.cells.push_back({"A-2", "union", "mm", "", std::nullopt, Verdict::ours, ""});
  return table;
}

TEST(ResultTable, WritesTextCsvAndLatexThatHoldTheSameCells) {
  const testing::TemporaryFolder folder;
  write_table(folder.path().string(), example());
  const CsvTable csv = read_csv(folder.file("table9.csv"));
  ASSERT_EQ(csv.rows.size(), 2u);
  EXPECT_EQ(csv.text(0, "printed"), "1.9");
  EXPECT_DOUBLE_EQ(*csv.number(0, "ours_high"), 1.6);
  EXPECT_EQ(csv.text(0, "verdict"), "differs");
  EXPECT_EQ(csv.text(0, "note"), "a \"quoted\", 5 % note");
  EXPECT_FALSE(csv.number(1, "ours_median"));
  const std::string text = testing::read_text(folder.file("table9.txt"));
  EXPECT_NE(text.find("1.500 [1.400, 1.600]"), std::string::npos) << text;
  const std::string latex = testing::read_text(folder.file("table9.tex"));
  EXPECT_NE(latex.find("5 \\% note"), std::string::npos) << latex;
}

TEST(CsvTable, ARowOfAnotherLengthIsNamedByItsLine) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("a.csv")) << "# comment\na,b\n1,2\n1,2,3\n";
  try {
    read_csv(folder.file("a.csv"));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.csv:4"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_csv(folder.file("missing.csv")), Error);
}

}  // namespace
}  // namespace alea::experiments
