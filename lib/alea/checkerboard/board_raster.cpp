#include "alea/checkerboard/board_raster.hpp"

#include <algorithm>

namespace alea {
namespace {

/// Sums of both kinds.
struct WindowSums {
  std::vector<Eigen::Array4d> plain;
  std::vector<Eigen::Array2d> alternating;

  explicit WindowSums(std::size_t places)
      : plain(places, Eigen::Array4d::Zero()), alternating(places, Eigen::Array2d::Zero()) {}
};

/// Sums weighed +1, -1, +1, ... over windows of `cells` cells of `step` values, at `places` places.
/// `box(k)`: the sum over one cell from k on.
template <typename Box>
void alternating_sums(int cells, std::size_t step, std::size_t places, const Box& box,
                      Eigen::Array2d* out) {
  const double end_sign = cells % 2 == 1 ? 1 : -1;
  const std::size_t last = (cells - 1) * step;
  for (std::size_t k = 0; k < std::min(step, places); ++k) {
    out[k] = box(k);
    for (int c = 1; c < cells; ++c) out[k] += (c % 2 == 0 ? 1 : -1) * box(k + c * step);
  }
  for (std::size_t k = step; k < places; ++k)  // all signs change, one cell goes, one comes
    out[k] = box(k - step) - out[k - step] + end_sign * box(k + last);
}

/// Sums along row y of the raster; `totals` is working memory of one value more than a row has.
void sum_row(const BoardRaster& raster, int y, const BoardSpec& board, int cell_px,
             std::vector<Eigen::Array4d>& totals, WindowSums& sums) {
  totals[0].setZero();
  for (int x = 0; x < raster.width(); ++x) totals[x + 1] = totals[x] + raster.at(x, y);
  const std::size_t places = sums.plain.size(), window = totals.size() - places;
  for (std::size_t x = 0; x < places; ++x) sums.plain[x] = totals[x + window] - totals[x];
  alternating_sums(
      board.columns, cell_px, places,
      [&](std::size_t k) -> Eigen::Array2d {
        return totals[k + cell_px].head<2>() - totals[k].head<2>();
      },
      sums.alternating.data());
}

}  // namespace

BoardWindows::BoardWindows(const BoardRaster& raster, const BoardSpec& board, int cell_px)
    : width_(std::max(raster.width() - board.columns * cell_px + 1, 0)),
      height_(std::max(raster.height() - board.rows * cell_px + 1, 0)) {
  if (width_ == 0 || height_ == 0) return;
  const auto w = static_cast<std::size_t>(width_), h = static_cast<std::size_t>(raster.height());
  std::vector<Eigen::Array4d> row_totals(raster.width() + 1);
  WindowSums row(w), totals((h + 1) * w);  // of rows 0 to y - 1 in row y
  for (std::size_t y = 0; y < h; ++y) {
    sum_row(raster, static_cast<int>(y), board, cell_px, row_totals, row);
    for (std::size_t x = 0, k = y * w; x < w; ++x, ++k) {
      totals.plain[k + w] = totals.plain[k] + row.plain[x];
      totals.alternating[k + w] = totals.alternating[k] + row.alternating[x];
    }
  }
  const std::size_t places = w * height_, window = board.rows * cell_px * w, step = cell_px * w;
  plain_.resize(places);
  for (std::size_t k = 0; k < places; ++k) plain_[k] = totals.plain[k + window] - totals.plain[k];
  alternating_.resize(places);
  alternating_sums(
      board.rows, step, places,
      [&](std::size_t k) -> Eigen::Array2d {
        return totals.alternating[k + step] - totals.alternating[k];
      },
      alternating_.data());
}

}  // namespace alea
