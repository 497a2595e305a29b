#include "alea/report/target_pdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/die/pip_layout.hpp"

namespace alea {
namespace {

constexpr double points_per_m = 72 / 0.0254;  // PDF's unit of length

/// One page: its size and the operators that draw it (PDF 32000-1, section 8). Lengths in metres.
class PdfPage {
 public:
  PdfPage(double width_m, double height_m) : width_m_(width_m), height_m_(height_m) {
    content_ = fmt::format("{0:.9g} 0 0 {0:.9g} 0 0 cm\n", points_per_m);
  }
  void grey(double level) { content_ += fmt::format("{0:.3g} g {0:.3g} G\n", level); }
  void box(double x, double y, double w, double h) {
    content_ += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} re f\n", x, y, w, h);
  }
  void line(double x0, double y0, double x1, double y1) {
    content_ += fmt::format("0.0002 w {:.9g} {:.9g} m {:.9g} {:.9g} l S\n", x0, y0, x1, y1);
  }
  void disc(double x, double y, double r) {
    const double k = 0.5522847498 * r;  // four Bezier curves, off the circle by 2.7e-4 r
    content_ += fmt::format("{:.9g} {:.9g} m\n", x + r, y);
    const std::array<std::array<double, 6>, 4> curves{
        {{r, k, k, r, 0, r}, {-k, r, -r, k, -r, 0}, {-r, -k, -k, -r, 0, -r}, {k, -r, r, -k, r, 0}}};
    for (const auto& c : curves)
      content_ += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} c\n", x + c[0], y + c[1],
                              x + c[2], y + c[3], x + c[4], y + c[5]);
    content_ += "f\n";
  }
  void text(double x, double y, double height_m, const std::string& words) {
    content_ +=
        fmt::format("BT /F1 {:.9g} Tf {:.9g} {:.9g} Td ({}) Tj ET\n", height_m, x, y, words);
  }
  /// Ten centimetres (or less on a small page) with a mark at each end.
  void ruler(double x, double y) {
    const double length = width_m_ > 0.12 ? 0.1 : 0.02;
    line(x, y, x + length, y);
    line(x, y - 0.001, x, y + 0.001);
    line(x + length, y - 0.001, x + length, y + 0.001);
    text(x, y + 0.0015, 0.0025, fmt::format("{:g} mm", 1000 * length));
  }
  const std::string& content() const { return content_; }
  double width_m() const { return width_m_; }
  double height_m() const { return height_m_; }

 private:
  double width_m_, height_m_;
  std::string content_;
};

/// A document of these pages with one standard font.
std::string pdf(const std::vector<PdfPage>& pages) {
  std::vector<std::string> objects(3);
  objects[0] = "<< /Type /Catalog /Pages 2 0 R >>";
  objects[2] = "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>";
  std::string kids;
  for (const PdfPage& page : pages) {
    // PDF readers take pages up to 14400 units; a larger page counts in a larger unit.
    double unit = 1;
    while (std::max(page.width_m(), page.height_m()) * points_per_m > 14400 * unit) unit *= 2;
    const std::size_t number = objects.size() + 1;
    kids += fmt::format("{} 0 R ", number);
    const std::string scaled =
        unit == 1 ? page.content()
                  : fmt::format("{0:.9g} 0 0 {0:.9g} 0 0 cm\n", 1 / unit) + page.content();
    objects.push_back(fmt::format(
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.6f} {:.6f}] /UserUnit {:g} /Resources << "
        "/Font << /F1 3 0 R >> >> /Contents {} 0 R >>",
        page.width_m() * points_per_m / unit, page.height_m() * points_per_m / unit, unit,
        number + 1));
    objects.push_back(fmt::format("<< /Length {} >>\nstream\n{}endstream", scaled.size(), scaled));
  }
  objects[1] = fmt::format("<< /Type /Pages /Kids [{}] /Count {} >>", kids, pages.size());
  std::string out = "%PDF-1.6\n";
  std::vector<std::size_t> offsets;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    offsets.push_back(out.size());
    out += fmt::format("{} 0 obj\n{}\nendobj\n", k + 1, objects[k]);
  }
  const std::size_t table = out.size();
  out += fmt::format("xref\n0 {}\n0000000000 65535 f \n", objects.size() + 1);
  for (const std::size_t offset : offsets) out += fmt::format("{:010d} 00000 n \n", offset);
  out += fmt::format("trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n",
                     objects.size() + 1, table);
  return out;
}

}  // namespace

std::string checkerboard_pdf(const BoardSpec& board) {
  require_valid(board);
  const double margin = std::max(0.5 * board.cell_m, 0.015);
  PdfPage page(board.side_m() + 2 * margin, board.height_m() + 2 * margin);
  page.grey(0);
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      if ((row + column) % 2 == 0)
        page.box(margin + column * board.cell_m, margin + row * board.cell_m, board.cell_m,
                 board.cell_m);
  const double x = page.width_m() / 2, y = page.height_m() / 2;
  page.grey(0.6);
  page.line(x, 0, x, 0.6 * margin);
  page.line(x, page.height_m() - 0.6 * margin, x, page.height_m());
  page.line(0, y, 0.6 * margin, y);
  page.line(page.width_m() - 0.6 * margin, y, page.width_m(), y);
  page.ruler(0.004, 0.004);
  return pdf({page});
}

std::string pips_pdf(double edge_m) {
  if (!(edge_m > 0) || !std::isfinite(edge_m))
    throw usage_error("pips: the edge must be a positive number of metres");
  const double margin = 0.015, radius = 0.09 * edge_m;
  std::vector<PdfPage> pages;
  int shown = 0;
  for (const PipPattern& pattern : pip_patterns) {
    if (pattern.pips == shown) continue;  // its other form is the same page turned
    shown = pattern.pips;
    PdfPage page(edge_m + 2 * margin, edge_m + 2 * margin);
    page.grey(0);
    for (int place = 0; place < pip_places; ++place) {
      if (!pattern.has(place)) continue;
      const Eigen::Vector2d at = pip_place(place, 0.25) * edge_m;
      page.disc(margin + at.x(), margin + at.y(), radius);
    }
    page.grey(0.6);
    const double low = margin, high = margin + edge_m;
    page.line(low, low, high, low);
    page.line(high, low, high, high);
    page.line(high, high, low, high);
    page.line(low, high, low, low);
    page.ruler(0.004, 0.004);
    pages.push_back(page);
  }
  return pdf(pages);
}

}  // namespace alea
