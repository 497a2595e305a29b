#include "alea/checkerboard/board_raster.hpp"

namespace alea {
namespace {

/// Windows of `cells` cells of `cell_px` pixels, weighed +1, -1, +1, ... or all +1.
struct Window {
  int cells, cell_px;
  bool alternating;

  int size() const { return cells * cell_px; }
};

/// The sum over a window at each of `places` places with `lanes` values side by side (1: along a
/// row of pixels; the width: down all columns at once). `totals`: running totals, one place more.
void window_sums(const Window& window, const double* totals, int places, int lanes, double* out) {
  const int step = window.cell_px * lanes, last = (places - window.size()) * lanes;
  const double end_sign = window.cells % 2 == 1 ? 1 : -1;
  const auto box = [&](int k) { return totals[k + step] - totals[k]; };
  for (int k = 0; k < last + lanes; ++k) {
    if (!window.alternating) {
      out[k] = totals[k + window.size() * lanes] - totals[k];
    } else if (k < step) {
      out[k] = 0;
      for (int c = 0; c < window.cells; ++c) out[k] += (c % 2 == 0 ? 1 : -1) * box(k + c * step);
    } else {  // one cell further: all signs change, one cell goes, one comes
      out[k] = box(k - step) - out[k - step] + end_sign * box(k + (window.cells - 1) * step);
    }
  }
}

}  // namespace

std::vector<double> window_map(const BoardRaster& raster, int plane, const BoardSpec& board,
                               int cell_px, bool alternating, WindowScratch& scratch) {
  const int w = raster.width(), h = raster.height();
  const auto& pixels = raster.plane(plane);
  const auto width = static_cast<std::size_t>(w);
  scratch.rows.assign(pixels.size(), 0);
  scratch.totals.assign(pixels.size() + width, 0);
  std::vector<double>& totals = scratch.totals;
  for (int y = 0; y < h; ++y) {
    const std::size_t base = y * width;
    for (std::size_t x = 0; x < width; ++x) totals[x + 1] = totals[x] + pixels[base + x];
    window_sums({board.columns, cell_px, alternating}, totals.data(), w, 1, &scratch.rows[base]);
  }
  std::fill_n(totals.begin(), width, 0.0);
  for (std::size_t k = 0; k < pixels.size(); ++k) totals[k + width] = totals[k] + scratch.rows[k];
  std::vector<double> out(pixels.size(), 0);
  window_sums({board.rows, cell_px, alternating}, totals.data(), h, w, out.data());
  return out;
}

}  // namespace alea
