#include "alea/checkerboard/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "alea/cloud/neighbours.hpp"
#include "alea/core/error.hpp"

namespace alea {

void require_valid(const BoardSpec& board) {
  if (board.columns < 2 || board.rows < 2 || board.columns > 1000 || board.rows > board.columns)
    throw usage_error(
        fmt::format("checkerboard of {} x {} cells: give at least 2 x 2, the longer count first",
                    board.columns, board.rows));
  if (!(board.cell_m > 0) || !std::isfinite(board.cell_m))
    throw usage_error("checkerboard: the side must be a positive number of metres");
}

int pattern_sign(const BoardSpec& board, const Eigen::Vector2d& place_m) {
  // Truncation would do inside the board; std::floor is a call of the C library here.
  const auto cell_of = [](double in_cells) {
    const int truncated = static_cast<int>(in_cells);
    return truncated - (in_cells < truncated ? 1 : 0);
  };
  const int column = cell_of(place_m.x() / board.cell_m + board.columns / 2.0);
  const int row = cell_of(place_m.y() / board.cell_m + board.rows / 2.0);
  return ((column + row) & 1) == 0 ? -1 : 1;
}

Cloud board_template(const BoardSpec& board, int points_along_side) {
  require_valid(board);
  if (points_along_side < board.columns)
    throw usage_error("checkerboard template: needs at least one point for each cell");
  const double spacing_m = board.side_m() / points_along_side;
  const int across = std::max(1, static_cast<int>(std::lround(board.height_m() / spacing_m)));
  Cloud cloud;
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < points_along_side; ++i) {
      const Eigen::Vector2d place((i + 0.5) * spacing_m - board.side_m() / 2,
                                  (j + 0.5) * board.height_m() / across - board.height_m() / 2);
      cloud.positions.emplace_back(place.x(), place.y(), 0);
      cloud.normals.emplace_back(0, 0, 1);
      cloud.intensity.push_back(pattern_sign(board, place) > 0 ? 1.0f : 0.0f);
    }
  }
  return cloud;
}

Cloud with_intensity(Cloud cloud) {
  if (cloud.has_intensity()) {
    // Some programs write an intensity of zero beside colours.
    const auto [least, most] = std::minmax_element(cloud.intensity.begin(), cloud.intensity.end());
    if (cloud.colours.empty() || *least < *most) return cloud;
    cloud.intensity.clear();
  }
  if (cloud.colours.empty())
    throw input_error(
        "the cloud has no intensity and no colour; a checkerboard cannot be read from it");
  cloud.intensity.reserve(cloud.size());
  for (const Colour& c : cloud.colours)
    cloud.intensity.push_back((static_cast<float>(c[0]) + c[1] + c[2]) / (3 * 65535.0f));
  return cloud;
}

double otsu_threshold(const std::vector<float>& values) {
  if (values.empty()) throw usage_error("otsu_threshold: no values");
  constexpr int bins = 128;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double start = *low, width = (static_cast<double>(*high) - *low) / bins;
  if (!(width > 0)) return start;
  std::array<double, bins> counts{};
  for (const float value : values)
    ++counts[std::min(bins - 1, static_cast<int>((value - start) / width))];
  double total = 0, total_sum = 0;
  for (int b = 0; b < bins; ++b) {
    total += counts[b];
    total_sum += b * counts[b];
  }
  double below = 0, below_sum = 0, best = -1;
  int first_best = 0, last_best = 0;
  for (int b = 0; b + 1 < bins; ++b) {
    below += counts[b];
    below_sum += b * counts[b];
    if (below == 0 || below == total) continue;
    const double gap = below_sum / below - (total_sum - below_sum) / (total - below);
    const double between = below * (total - below) * gap * gap;
    if (between > best * (1 + 1e-12)) {
      best = between;
      first_best = b;
    }
    if (between >= best * (1 - 1e-12)) last_best = b;
  }
  // Empty bins between the classes leave a plateau: its middle is the threshold.
  return start + width * (0.5 * (first_best + last_best) + 1);
}

double colour_score(const Cloud& board_in_target_frame, const Cloud& target,
                    double target_threshold, double gate_m) {
  if (board_in_target_frame.empty() || target.empty()) return 0;
  const NeighbourIndex index(target.positions);
  std::size_t matched = 0;
  for (std::size_t i = 0; i < board_in_target_frame.size(); ++i) {
    const auto nearest = index.nearest_one(board_in_target_frame.positions[i], gate_m);
    if (!nearest) continue;
    const bool light = target.intensity[nearest->index] > target_threshold;
    matched += light == (board_in_target_frame.intensity[i] > 0.5f);
  }
  return static_cast<double>(matched) / static_cast<double>(board_in_target_frame.size());
}

}  // namespace alea
