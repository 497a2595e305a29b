#include "alea/report/page.hpp"

#include <fmt/format.h>

#include <array>
#include <list>

#include "alea/core/error.hpp"
#include "alea/core/version.hpp"
#include "alea/io/atomic_file.hpp"

namespace alea {
namespace {

constexpr const char* style =
    "body{font:16px/1.45 sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#282c34}"
    "h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}"
    ".verdict{padding:.6rem .8rem;border-left:.4rem solid #3a7d44;background:#eef5ef}"
    ".refused{border-color:#d1495b;background:#fbeef0}"
    "table{border-collapse:collapse;font-size:.9rem}td,th{padding:.15rem .6rem;text-align:right;"
    "border-bottom:1px solid #dee1e6}td:first-child,th:first-child{text-align:left}"
    "figure{margin:1.2rem 0}img{max-width:100%;border:1px solid #dee1e6}"
    "figcaption,.note{font-size:.9rem;color:#555b66}pre{font-size:.9rem}";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

std::string table_html(const PageTable& table) {
  std::string out = fmt::format("<h2>{}</h2>\n<table>\n<tr>", escaped(table.title));
  for (const std::string& column : table.columns)
    out += fmt::format("<th>{}</th>", escaped(column));
  out += "</tr>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const std::string& cell : row) out += fmt::format("<td>{}</td>", escaped(cell));
    out += "</tr>\n";
  }
  out += "</table>\n";
  if (!table.note.empty()) out += fmt::format("<p class=\"note\">{}</p>\n", escaped(table.note));
  return out;
}

std::string figure_html(const PageFigure& figure, const std::string& png) {
  return fmt::format(
      "<h2>{0}</h2>\n<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">\n"
      "<figcaption>{2} ({3})</figcaption></figure>\n",
      escaped(figure.title), base64(png), escaped(figure.caption), escaped(figure.file));
}

std::string html_of(const Page& page, const std::vector<std::string>& pngs) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n<p class=\"{2}\">{3}</p>\n",
      escaped(page.title), style, page.refused ? "verdict refused" : "verdict",
      escaped(page.verdict));
  if (!page.notes.empty()) {
    out += "<ul>\n";
    for (const std::string& note : page.notes) out += fmt::format("<li>{}</li>\n", escaped(note));
    out += "</ul>\n";
  }
  for (const PageTable& table : page.tables) out += table_html(table);
  for (std::size_t i = 0; i < page.figures.size(); ++i)
    out += figure_html(page.figures[i], pngs[i]);
  return out + fmt::format("<p class=\"note\">alea {}</p>\n</body></html>\n", version());
}

std::vector<std::string> encoded(const Page& page) {
  std::vector<std::string> pngs;
  for (const PageFigure& figure : page.figures) pngs.push_back(encode_png(figure.picture));
  return pngs;
}

}  // namespace

std::string page_html(const Page& page) {
  return html_of(page, encoded(page));
}

void write_page(const std::filesystem::path& folder, const Page& page) {
  const std::vector<std::string> pngs = encoded(page);
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder))
    throw input_error(
        fmt::format("{}: cannot make the folder: {}; choose a place that can be written",
                    folder.string(), failure ? failure.message() : "it is not a folder"));
  std::list<AtomicFile> files;
  for (std::size_t i = 0; i < pngs.size(); ++i)
    files.emplace_back(folder / page.figures[i].file).write(pngs[i]);
  files.emplace_back(folder / "index.html").write(html_of(page, pngs));
  for (AtomicFile& file : files) file.commit();
}

}  // namespace alea
