#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// Count, sum and sum of squares of the intensities in square pixels.
class BoardRaster {
 public:
  BoardRaster(int width, int height) : width_(width), height_(height) {
    for (auto& plane : planes_) plane.resize(static_cast<std::size_t>(width) * height);
  }
  void add(int x, int y, float intensity) {
    const std::size_t at = static_cast<std::size_t>(y) * width_ + x;
    planes_[0][at] += 1;
    planes_[1][at] += intensity;
    planes_[2][at] += intensity * intensity;
  }
  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<float>& plane(int k) const { return planes_[k]; }

 private:
  int width_, height_;
  std::array<std::vector<float>, 3> planes_;  // count, sum, sum of squares
};

/// Working memory of window_map, kept between its calls.
struct WindowScratch {
  std::vector<double> rows, totals;
};

/// For each pixel the sum of a plane over the outline of a board whose first cell begins there,
/// cells of `cell_px` pixels: all weighed +1, or as a checkerboard that begins with +1
/// (`alternating`). Places whose outline does not fit hold nothing of use. Each costs as many
/// additions as the board has columns and rows.
std::vector<double> window_map(const BoardRaster& raster, int plane, const BoardSpec& board,
                               int cell_px, bool alternating, WindowScratch& scratch);

}  // namespace alea
