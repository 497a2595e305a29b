#include "alea/checkerboard/board_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace alea {
namespace {

/// Of the mean difference of neighbouring cells. One dark cell alone, as the outer corner of a
/// board in a light wall shows it, makes half of the pairs of 2 x 2 cells differ by noise only:
/// both that are left have the right sign in one scene out of three.
constexpr double least_share_of_mean = 0.25;

struct Cells {
  std::vector<double> sum, count;
  double mean(std::size_t k) const { return sum[k] / count[k]; }
};

/// Means over the inner part of each cell, where the neighbours' blur does not reach.
Cells cell_means(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                 std::span<const float> intensity, const BoardFit& fit) {
  Cells cells{std::vector<double>(board.cells()), std::vector<double>(board.cells())};
  const OnBoard on_board(fit.pose);
  const double margin = std::min(fit.blur_m.maxCoeff() / board.cell_m, 0.25);
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const Eigen::Vector2d at =
        on_board(places_m[i]) / fit.cell_m + Eigen::Vector2d(board.columns, board.rows) / 2;
    if (!(at.x() >= 0 && at.y() >= 0 && at.x() < board.columns && at.y() < board.rows)) continue;
    const int column = static_cast<int>(at.x()), row = static_cast<int>(at.y());
    const double from_edge =
        std::min({at.x() - column, column + 1 - at.x(), at.y() - row, row + 1 - at.y()});
    if (from_edge < margin) continue;
    const auto cell = static_cast<std::size_t>(row) * board.columns + column;
    cells.sum[cell] += intensity[i];
    cells.count[cell] += 1;
  }
  return cells;
}

/// Points of one outer column (or row), seen along the axis that leaves the board.
struct Profile {
  double edge_m = 0;  ///< where the pattern ends, from the middle
  double beyond = 0;  ///< mean agreement just outside the outline: -1 where cells alternate on
  double beyond_weight = 0;
};

Profile profile_of(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                   std::span<const float> intensity, const BoardFit& fit, int axis, double side,
                   double spacing_m) {
  const double half = 0.5 * fit.cell_m * (axis == 0 ? board.columns : board.rows);
  const double half_across = 0.5 * fit.cell_m * (axis == 0 ? board.rows : board.columns);
  const double cell = fit.cell_m;
  const OnBoard on_board(fit.pose);
  const BlurredPattern pattern({board.columns, board.rows, cell}, fit.blur_m);
  std::vector<std::pair<double, double>> gains;  // distance from the middle, gain of being inside
  Profile profile;
  double beyond_sum = 0;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const Eigen::Vector2d at = on_board(places_m[i]);
    const double out = side * at[axis], across = at[1 - axis];
    if (std::abs(across) > half_across - 0.05 * cell) continue;
    if (out < half - 0.85 * cell || out > half + 0.9 * cell) continue;
    Eigen::Vector2d in_last = at;  // same row, in the outermost column
    in_last[axis] = side * (half - 0.5 * cell);
    const double sign = pattern.at(in_last).value;
    const double agreement =
        std::clamp((intensity[i] - fit.mean) / fit.half_contrast, -1.5, 1.5) * sign;
    gains.emplace_back(out, agreement - 0.5 * sign * sign);
    if (out > half + 0.15 * cell && out < half + 0.85 * cell) {
      beyond_sum += agreement;
      profile.beyond_weight += sign * sign;
    }
  }
  std::sort(gains.begin(), gains.end());
  double sum = 0, best = 0;
  profile.edge_m = half - 0.85 * cell;
  bool at_end = false;
  for (std::size_t k = 0; k < gains.size(); ++k) {
    sum += gains[k].second;
    if (sum < best) continue;
    best = sum;
    profile.edge_m = gains[k].first;
    at_end = k + 1 == gains.size();
  }
  if (at_end) profile.edge_m += spacing_m / 2;  // the board goes on to half way to the next point
  if (profile.beyond_weight > 0) profile.beyond = beyond_sum / profile.beyond_weight;
  return profile;
}

/// What check_pattern asks for.
struct Agreement {
  CellPairs pairs;
  double correlation = 0, least_correlation = 0, least_right = 0;
  bool seen_enough = false;

  Refusal refusal(const BoardSpec& board) const {
    return {RefusalCode::no_pattern,
            fmt::format("no {} x {} checkerboard: intensities correlate {:.2f} with the pattern "
                        "(needed {:.2f}), {} of {} neighbouring cells differ the right way ({} "
                        "seen)",
                        board.columns, board.rows, correlation, least_correlation, pairs.right,
                        pairs.all, pairs.seen)};
  }
};

Agreement agreement_of(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                       std::span<const float> intensity, const BoardFit& fit) {
  Agreement agreement;
  agreement.correlation = correlate(board, places_m, intensity, fit.pose).correlation;
  agreement.pairs = cell_pairs(board, places_m, intensity, fit);
  const bool small = board.few_cells();
  const double n = static_cast<double>(std::max<std::size_t>(fit.points, 1));
  // Among all poses that the search tries, noise alone reaches about 4.3 / sqrt(n).
  agreement.least_correlation = std::max(small ? 0.5 : 0.35, 6 / std::sqrt(n));
  agreement.least_right = (small ? 1.0 : 0.75) * agreement.pairs.seen;
  agreement.seen_enough = 2 * agreement.pairs.seen >= (small ? 2 : 1) * agreement.pairs.all;
  return agreement;
}

}  // namespace

CellPairs cell_pairs(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                     std::span<const float> intensity, const BoardFit& fit) {
  const Cells cells = cell_means(board, places_m, intensity, fit);
  CellPairs pairs;
  std::vector<double> differences;  // light less dark
  const auto compare = [&](int column, int row, int step_column, int step_row) {
    const auto a = static_cast<std::size_t>(row * board.columns + column);
    const auto b =
        static_cast<std::size_t>((row + step_row) * board.columns + column + step_column);
    ++pairs.all;
    if (cells.count[a] == 0 || cells.count[b] == 0) return;
    ++pairs.seen;
    const bool a_is_light = (column + row) % 2 == 1;
    differences.push_back((a_is_light ? 1 : -1) * (cells.mean(a) - cells.mean(b)));
  };
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      if (column + 1 < board.columns) compare(column, row, 1, 0);
      if (row + 1 < board.rows) compare(column, row, 0, 1);
    }
  }
  double least = 0;
  if (board.few_cells())
    for (const double one : differences)
      least += least_share_of_mean * one / static_cast<double>(pairs.seen);
  for (const double one : differences) pairs.right += one > std::max(least, 0.0);
  return pairs;
}

std::optional<Refusal> check_roughly(const BoardSpec& board,
                                     std::span<const Eigen::Vector2d> places_m,
                                     std::span<const float> intensity, const BoardFit& fit) {
  const Agreement agreement = agreement_of(board, places_m, intensity, fit);
  if (agreement.correlation >= 0.7 * agreement.least_correlation && fit.half_contrast > 0 &&
      agreement.seen_enough)
    return std::nullopt;
  return agreement.refusal(board);
}

std::optional<Refusal> check_pattern(const BoardSpec& board,
                                     std::span<const Eigen::Vector2d> places_m,
                                     std::span<const float> intensity, const BoardFit& fit) {
  const Agreement agreement = agreement_of(board, places_m, intensity, fit);
  if (agreement.correlation >= agreement.least_correlation && fit.half_contrast > 0 &&
      agreement.seen_enough && agreement.pairs.right >= agreement.least_right)
    return std::nullopt;
  return agreement.refusal(board);
}

BoardExtent board_extent(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                         std::span<const float> intensity, const BoardFit& fit, double spacing_m) {
  BoardExtent extent;
  for (int axis = 0; axis < 2; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Profile profile = profile_of(board, places_m, intensity, fit, axis, side, spacing_m);
      extent.size_m[axis] += profile.edge_m;
      extent.longer_half_m[axis] = std::max(extent.longer_half_m[axis], profile.edge_m);
      if (profile.beyond < -0.55 && profile.beyond_weight > 8) extent.continues = true;
    }
  }
  return extent;
}

std::optional<Refusal> check_size(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                                  std::span<const float> intensity, const BoardFit& fit,
                                  double spacing_m) {
  const BoardExtent extent = board_extent(board, places_m, intensity, fit, spacing_m);
  if (extent.continues)
    return Refusal{
        RefusalCode::size_mismatch,
        fmt::format("the pattern goes on beyond {} x {} cells of {:.4f} m; give --squares "
                    "and --side of the whole board",
                    board.columns, board.rows, board.cell_m)};
  const Eigen::Vector2d expected(board.side_m(), board.height_m());
  for (int axis = 0; axis < 2; ++axis) {
    double larger_m = extent.size_m[axis] - expected[axis];
    // The crossing of a 2 x 2 board is its middle, whatever hides a part: one half shows the size.
    if (larger_m < 0 && board.cells() == 4)
      larger_m = 2 * extent.longer_half_m[axis] - expected[axis];
    // Noise of the places spreads points beyond the outline; it shows as blur.
    const double spread_m = larger_m > 0 ? 3 * fit.blur_m.maxCoeff() : 0;
    if (std::abs(larger_m) <= 0.15 * 2 * board.cell_m + spacing_m + spread_m) continue;
    return Refusal{RefusalCode::size_mismatch,
                   fmt::format("a pattern like it ends after {:.4f} x {:.4f} m instead of {:.4f} x "
                               "{:.4f} m; check --side and --squares, and whether a part is hidden",
                               extent.size_m.x(), extent.size_m.y(), expected.x(), expected.y())};
  }
  return std::nullopt;
}

}  // namespace alea
