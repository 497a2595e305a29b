#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// Count, sum and sum of squares of the intensities in square pixels. Those of a pixel lie side by
/// side, so that one instruction adds more than one of them.
class BoardRaster {
 public:
  BoardRaster(int width, int height)
      : width_(width), height_(height), pixels_(4 * static_cast<std::size_t>(width) * height) {}

  void add(int x, int y, float intensity) {
    float* pixel = &pixels_[4 * (static_cast<std::size_t>(y) * width_ + x)];
    pixel[0] += 1;
    pixel[1] += intensity;
    pixel[2] += intensity * intensity;
  }
  int width() const { return width_; }
  int height() const { return height_; }
  Eigen::Array4d at(int x, int y) const {
    return Eigen::Map<const Eigen::Array4f>(
               &pixels_[4 * (static_cast<std::size_t>(y) * width_ + x)])
        .cast<double>();
  }

 private:
  int width_, height_;
  std::vector<float> pixels_;  // the fourth of each stays zero
};

/// Sums over the outline of a board whose first cell begins at a pixel, cells of `cell_px` pixels,
/// for every pixel where the outline fits. Each costs as many additions as the board has columns
/// and rows.
class BoardWindows {
 public:
  BoardWindows(const BoardRaster& raster, const BoardSpec& board, int cell_px);

  int width() const { return width_; }    ///< places along x
  int height() const { return height_; }  ///< places along y

  /// Count, sum, sum of squares.
  const Eigen::Array4d& plain(int x, int y) const { return plain_[place(x, y)]; }
  /// Count and sum weighed as a checkerboard that begins with +1.
  const Eigen::Array2d& alternating(int x, int y) const { return alternating_[place(x, y)]; }

 private:
  std::size_t place(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  int width_, height_;
  std::vector<Eigen::Array4d> plain_;
  std::vector<Eigen::Array2d> alternating_;
};

}  // namespace alea
