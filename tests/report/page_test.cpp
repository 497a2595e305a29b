#include "alea/report/page.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "alea/core/error.hpp"
#include "alea/report/canvas.hpp"
#include "tests/support/png.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

Page small_page() {
  return {.title = "A & B",
          .verdict = "registered",
          .tables = {{"Numbers", {"what", "mm"}, {{"offset <1>", "0.12"}}, "all of them"}},
          .figures = {{"one.png", "One", "the first", Canvas(20, 10).picture()},
                      {"two.png", "Two", "the second", Canvas(5, 40).picture()}}};
}

TEST(Page, NeedsNoOtherFileAndEscapesItsText) {
  const std::string html = page_html(small_page());
  EXPECT_NE(html.find("<h1>A &amp; B</h1>"), std::string::npos);
  EXPECT_NE(html.find("<td>offset &lt;1&gt;</td><td>0.12</td>"), std::string::npos);
  EXPECT_NE(html.find("src=\"data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_EQ(html.find("src=\"one.png\""), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
}

TEST(Page, WritesEveryPictureBesideIt) {
  const testing::TemporaryFolder folder;
  write_page(folder.path() / "new" / "report", small_page());
  const auto report = folder.path() / "new" / "report";
  EXPECT_EQ(testing::decode_png(testing::read_text(report / "two.png")).height, 40);
  EXPECT_EQ(testing::read_text(report / "index.html"), page_html(small_page()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(report), {}), 3);
}

TEST(Page, APlaceThatCannotBeWrittenIsBadInputAndLeavesNothing) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("taken")) << "a file";
  EXPECT_THROW(write_page(folder.path() / "taken", small_page()), Error);
  // A folder where a picture should go: nothing of the page may appear.
  std::filesystem::create_directories(folder.path() / "report" / "two.png");
  EXPECT_THROW(write_page(folder.path() / "report", small_page()), Error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path() / "report"), {}), 1);
}

}  // namespace
}  // namespace alea
