#include "alea/checkerboard/board_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "alea/checkerboard/board_raster.hpp"
#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

/// Log-likelihood ratio of one point. Capped: on data without noise half a board, whose two cells
/// are right to the last point, would win over the whole one on a raster a little off; the rest
/// decides between poses at the cap.
double gain_of_one(double squared_correlation) {
  constexpr double cap = 0.8, rest = 0.1;
  return -0.5 * std::log(1 - std::min(squared_correlation, cap)) + 0.5 * rest * squared_correlation;
}

/// Sums over the points of one outline: s is the pattern's sign, i the intensity.
struct OutlineSums {
  double n = 0, i = 0, ii = 0, s = 0, si = 0;

  double correlation() const {
    const double ss_about = n - s * s / n, ii_about = ii - i * i / n;
    if (!(n > 2) || !(ss_about > 1e-9 * n) || !(ii_about > 1e-12 * n)) return 0;
    return (si - s * i / n) / std::sqrt(ss_about * ii_about);
  }
  double gain() const { return gain(correlation()); }
  double gain(double r) const { return n * gain_of_one(r * r); }
};

/// How the search is laid out.
struct Grid {
  double pixel_m = 0, half_m = 0, angle_step_rad = 0;
  int cell_px = 0, size_px = 0, angles = 0;
};

Grid make_grid(const BoardSpec& board, const BoardSearchOptions& options) {
  Grid grid;
  grid.cell_px = board.columns <= 3 ? 8 : board.columns == 4 ? 6 : board.columns <= 8 ? 5 : 3;
  grid.pixel_m = board.cell_m / grid.cell_px;
  const double half_diagonal_m = 0.5 * std::hypot(board.side_m(), board.height_m());
  const double reach_m = options.radius_m + 0.5 * board.side_m() + grid.pixel_m;
  grid.size_px = 2 * static_cast<int>(std::ceil(reach_m / grid.pixel_m)) + 1;
  grid.half_m = 0.5 * grid.size_px * grid.pixel_m;
  const double range_rad = (board.square() ? 90 : 180) * deg;
  const double step_rad = std::min(3 * deg, 0.4 * board.cell_m / half_diagonal_m);
  grid.angles = static_cast<int>(std::ceil(range_rad / step_rad));
  grid.angle_step_rad = range_rad / grid.angles;
  return grid;
}

/// The pattern fits with either sign where a turn of the board swaps dark and light.
bool sign_is_free(const BoardSpec& board) {
  return (board.square() && board.columns % 2 == 0) || !board.half_turn_symmetric();
}

/// A negative correlation is a positive one of the board turned by a quarter (square) or a half.
BoardCandidate with_positive_sign(const BoardSpec& board, BoardCandidate candidate) {
  if (candidate.correlation < 0 && sign_is_free(board)) {
    candidate.pose.angle_rad += (board.square() ? 90 : 180) * deg;
    candidate.correlation = -candidate.correlation;
  }
  return candidate;
}

void keep_best(const BoardSpec& board, std::size_t most, const BoardCandidate& candidate,
               std::vector<BoardCandidate>& best) {
  const double apart_m = 0.5 * board.height_m();
  for (BoardCandidate& other : best) {
    if ((other.pose.centre_m - candidate.pose.centre_m).norm() >= apart_m) continue;
    if (candidate.gain > other.gain) other = candidate;
    return;
  }
  best.push_back(candidate);
  if (best.size() > 8 * most) {
    std::stable_sort(best.begin(), best.end(),
                     [](const auto& a, const auto& b) { return a.gain > b.gain; });
    best.resize(4 * most);
  }
}

BoardRaster intensities_on_raster(const Grid& grid, std::span<const Eigen::Vector2d> places_m,
                                  const std::vector<float>& intensity, const BoardPose2& pose) {
  BoardRaster raster(grid.size_px, grid.size_px);
  const double c = std::cos(pose.angle_rad), s = std::sin(pose.angle_rad);
  const double pixels_per_m = 1 / grid.pixel_m;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const Eigen::Vector2d from = places_m[i] - pose.centre_m;
    const double x = (c * from.x() + s * from.y() + grid.half_m) * pixels_per_m;
    const double y = (-s * from.x() + c * from.y() + grid.half_m) * pixels_per_m;
    if (x >= 0 && y >= 0 && x < grid.size_px && y < grid.size_px)
      raster.add(static_cast<int>(x), static_cast<int>(y), intensity[i]);
  }
  return raster;
}

/// The first cell is dark, -1; the windows begin with +1.
OutlineSums sums_at(const BoardWindows& windows, int x, int y) {
  const Eigen::Array4d& plain = windows.plain(x, y);
  const Eigen::Array2d& alternating = windows.alternating(x, y);
  return {plain[0], plain[1], plain[2], -alternating[0], -alternating[1]};
}

/// The candidate at sums of an outline, without its place; nothing where its gain is below `least`.
std::optional<BoardCandidate> candidate_of(const OutlineSums& sums, bool free_sign, double least) {
  BoardCandidate candidate;
  candidate.correlation = sums.correlation();
  if (candidate.correlation == 0 || (candidate.correlation < 0 && !free_sign)) return {};
  const double r2 = candidate.correlation * candidate.correlation;
  // -log(1 - r2) is at most r2 / (1 - r2), which costs less.
  if (0.55 * sums.n * r2 < least * (1 - r2)) return {};
  candidate.gain = sums.gain(candidate.correlation);
  if (candidate.gain < least) return {};
  candidate.points = static_cast<std::size_t>(sums.n);
  return candidate;
}

/// The best centres at one angle.
std::vector<BoardCandidate> search_angle(const BoardSpec& board, const Grid& grid,
                                         std::span<const Eigen::Vector2d> places_m,
                                         const std::vector<float>& intensity, double angle_rad,
                                         const BoardSearchOptions& options) {
  const BoardWindows windows(
      intensities_on_raster(grid, places_m, intensity, {options.about_m, angle_rad}), board,
      grid.cell_px);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const bool free_sign = sign_is_free(board);
  std::vector<BoardCandidate> best;
  double best_gain = 0;
  for (int y = 0; y < windows.height(); ++y) {
    for (int x = 0; x < windows.width(); ++x) {
      const Eigen::Vector2d turned = Eigen::Vector2d(x, y) * grid.pixel_m -
                                     Eigen::Vector2d::Constant(grid.half_m) +
                                     Eigen::Vector2d(board.side_m(), board.height_m()) / 2;
      if (turned.norm() > options.radius_m) continue;
      auto candidate = candidate_of(sums_at(windows, x, y), free_sign,
                                    BoardSearchOptions::least_gain_share * best_gain);
      if (!candidate) continue;
      best_gain = std::max(best_gain, candidate->gain);
      candidate->pose = {options.about_m + Eigen::Vector2d(c * turned.x() - s * turned.y(),
                                                           s * turned.x() + c * turned.y()),
                         angle_rad};
      keep_best(board, options.most_candidates, with_positive_sign(board, *candidate), best);
    }
  }
  return best;
}

/// Best first, at most `most`, at least half the shorter side apart.
std::vector<BoardCandidate> best_apart(const BoardSpec& board, std::size_t most,
                                       std::vector<BoardCandidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.gain > b.gain; });
  const double apart_m = 0.5 * board.height_m();
  std::vector<BoardCandidate> separate;
  for (const BoardCandidate& one : candidates)
    if (separate.size() < most &&
        std::none_of(separate.begin(), separate.end(), [&](const BoardCandidate& better) {
          return (better.pose.centre_m - one.pose.centre_m).norm() < apart_m;
        }))
      separate.push_back(one);
  return separate;
}

/// The points that the search looks at. A board of few cells must correlate by 0.5 at least, which
/// 2,000 points of a crop show beyond doubt: each then stands for `weight` points.
struct SearchedPoints {
  std::vector<Eigen::Vector2d> places;
  std::vector<float> intensity;
  double weight = 1;
};

SearchedPoints searched_points(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                               std::span<const float> intensity) {
  constexpr std::size_t enough = 2000;
  const std::size_t stride =
      board.few_cells() ? std::max<std::size_t>(1, places_m.size() / enough) : 1;
  SearchedPoints some;
  some.weight = static_cast<double>(stride);
  for (std::size_t i = 0; i < places_m.size(); i += stride) {
    some.places.push_back(places_m[i]);
    some.intensity.push_back(intensity[i]);
  }
  return some;
}

std::vector<float> clipped(std::vector<float> values) {
  std::vector<float> sorted = values;
  const std::size_t n = sorted.size(), low = n / 50, high = n - 1 - n / 50;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(low), sorted.end());
  const float least = sorted[low];
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(high),
                   sorted.end());
  const float most = sorted[high];
  // About the middle, in [-1, 1], so that sums of squares lose nothing to a common level.
  const float middle = (least + most) / 2, half = std::max((most - least) / 2, 1e-30f);
  for (float& value : values) value = (std::clamp(value, least, most) - middle) / half;
  return values;
}

}  // namespace

double most_gain(std::size_t points) {
  return static_cast<double>(points) * gain_of_one(1);
}

std::vector<BoardCandidate> search_board(const BoardSpec& board,
                                         std::span<const Eigen::Vector2d> places_m,
                                         std::span<const float> intensity,
                                         const BoardSearchOptions& options) {
  if (places_m.size() < 8) return {};
  const Grid grid = make_grid(board, options);
  const SearchedPoints some = searched_points(board, places_m, intensity);
  const std::vector<float> values = clipped(some.intensity);
  std::vector<std::vector<BoardCandidate>> parts(grid.angles);
  parallel_chunks(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      parts[k] = search_angle(board, grid, some.places, values,
                              static_cast<double>(k) * grid.angle_step_rad, options);
  });
  std::vector<BoardCandidate> best;
  for (const auto& part : parts)
    for (const BoardCandidate& candidate : part)
      keep_best(board, options.most_candidates, candidate, best);
  best = best_apart(board, options.most_candidates, std::move(best));
  for (BoardCandidate& one : best) {
    one.gain *= some.weight;
    one.points = static_cast<std::size_t>(some.weight * static_cast<double>(one.points));
  }
  const double least = best.empty() ? 0 : BoardSearchOptions::least_gain_share * best[0].gain;
  std::erase_if(best, [least](const BoardCandidate& one) { return one.gain < least; });
  return best;
}

BoardCandidate correlate(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                         std::span<const float> intensity, const BoardPose2& pose) {
  OutlineSums sums;
  const OnBoard on_board(pose);
  double level = 0;
  for (const float value : intensity) level += value;
  level /= static_cast<double>(std::max<std::size_t>(intensity.size(), 1));
  for (std::size_t k = 0; k < places_m.size(); ++k) {
    const Eigen::Vector2d at = on_board(places_m[k]);
    if (!in_outline(board, at)) continue;
    const double s = pattern_sign(board, at), i = intensity[k] - level;
    sums.n += 1;
    sums.i += i;
    sums.ii += i * i;
    sums.s += s;
    sums.si += s * i;
  }
  return {pose, sums.correlation(), sums.n > 2 ? sums.gain() : 0, static_cast<std::size_t>(sums.n)};
}

}  // namespace alea
