#include "alea/checkerboard/board_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "alea/checkerboard/board_crop.hpp"
#include "alea/checkerboard/saddle_search.hpp"
#include "alea/cloud/neighbours.hpp"
#include "alea/core/error.hpp"

namespace alea {
namespace {

/// The spread of intensities between their 1 % and 99 % quantiles.
double intensity_range(const Cloud& cloud) {
  std::vector<float> values = cloud.intensity;
  const std::size_t n = values.size(), low = n / 100, high = n - 1 - n / 100;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(low), values.end());
  const double least = values[low];
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(high),
                   values.end());
  return values[high] - least;
}

/// One saddle for each corner: the strongest of those nearer than corners can be.
std::vector<Saddle> one_a_corner(const BoardSpec& board, const std::vector<Saddle>& saddles) {
  std::vector<Eigen::Vector3d> places;
  for (const Saddle& saddle : saddles) places.push_back(saddle.place_m);
  const NeighbourIndex index(places);
  std::vector<std::uint8_t> dropped(saddles.size());
  std::vector<Saddle> corners;
  for (std::size_t k = 0; k < saddles.size(); ++k) {
    if (dropped[k]) continue;
    corners.push_back(saddles[k]);
    for (const Neighbour& weaker : index.within(places[k], 0.6 * board.cell_m))
      dropped[weaker.index] = 1;
  }
  return corners;
}

/// How far another corner lies and is turned as on a board: 1, or -1 for the contrary. Along the
/// edges of the cells, which lie half way between a corner's axis and its perpendicular, each step
/// of a cell turns the axis by a quarter.
double agreement(const BoardSpec& board, const Saddle& corner, const Saddle& other) {
  const Eigen::Vector3d off = (other.place_m - corner.place_m) / board.cell_m;
  const double along = off.dot(corner.axis);
  const double across = std::sqrt(std::max(off.squaredNorm() - along * along, 0.0));
  const auto steps = std::lround((along + across) / std::numbers::sqrt2) +
                     std::lround((along - across) / std::numbers::sqrt2);
  const double cosine = corner.axis.dot(other.axis);
  return (steps % 2 == 0 ? 1 : -1) * (2 * cosine * cosine - 1);
}

/// The corners whose neighbours, up to two cells away, lie and are turned as on the board: more
/// agree than contradict, by a quarter of the neighbours that every corner has. Of saddles that
/// noise makes about as many contradict.
std::vector<Saddle> as_on_board(const BoardSpec& board, const std::vector<Saddle>& corners) {
  std::vector<Eigen::Vector3d> places;
  for (const Saddle& corner : corners) places.push_back(corner.place_m);
  const NeighbourIndex index(places);
  const double neighbours = std::min(3, board.columns - 1) * std::min(3, board.rows - 1) - 1;
  std::vector<Saddle> kept;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    double count = 0;
    for (const Neighbour& one : index.within(places[k], 2.5 * board.cell_m))
      if (one.index != k) count += agreement(board, corners[k], corners[one.index]);
    if (count >= 0.25 * neighbours) kept.push_back(corners[k]);
  }
  return kept;
}

/// Where to look on a board of many cells: amid most of its inner corners first. A
/// corner with fewer others in reach than a quarter of them is left out: half of the cells must be
/// seen, and three quarters of what is seen be right.
std::vector<Eigen::Vector3d> amid_others(const BoardSpec& board,
                                         const std::vector<Saddle>& corners) {
  std::vector<Eigen::Vector3d> places;
  for (const Saddle& corner : corners) places.push_back(corner.place_m);
  const double reach_m = 0.5 * board.cell_m * std::hypot(board.columns - 1, board.rows - 1);
  const auto least = static_cast<std::size_t>((board.columns - 1) * (board.rows - 1)) / 4;
  const NeighbourIndex index(places);
  std::vector<std::pair<std::size_t, std::size_t>> amid;  // corners in reach
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t count = index.within(places[k], reach_m).size();
    if (count >= least) amid.emplace_back(count, k);
  }
  std::stable_sort(amid.begin(), amid.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Eigen::Vector3d> sorted;
  for (const auto& one : amid) sorted.push_back(places[one.second]);
  return sorted;
}

/// Best first. A saddle is the centre of a 2 x 2 board, else any of its inner corners; where there
/// are few, one alone may be seen.
std::vector<Eigen::Vector3d> places_to_try(const BoardSpec& board, const Cloud& cloud,
                                           const CubeIndex& index, double cube_m) {
  const std::vector<Saddle> saddles =
      find_saddles(index, cube_m, 0.9 * board.cell_m, 0.15 * intensity_range(cloud), 0.25);
  if (!board.few_cells())
    return amid_others(board, as_on_board(board, one_a_corner(board, saddles)));
  std::vector<Eigen::Vector3d> places;
  for (const Saddle& saddle : saddles) places.push_back(saddle.place_m);
  return places;
}

bool is_near(const std::vector<Eigen::Vector3d>& places, const Eigen::Vector3d& place, double m) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Eigen::Vector3d& other) { return (other - place).norm() < m; });
}

}  // namespace

Result<std::vector<BoardMeasurement>> find_boards(const Cloud& cloud, const BoardOptions& options) {
  const BoardSpec& board = options.board;
  require_valid(board);
  if (!cloud.has_intensity())
    throw input_error(
        "the cloud has no intensity or colour; a checkerboard cannot be read from it");
  std::vector<BoardMeasurement> found;
  const Eigen::Vector3d scanner = scanner_of(cloud, options);
  const double cube_m = board.cell_m / 3;
  const CubeIndex index(cloud, cube_m);
  constexpr std::size_t most_tries = 300;
  std::vector<Eigen::Vector3d> tried, centres;
  // The saddle next to a centre lies within `apart_m` of one that was tried.
  const double apart_m = (board.columns > 2 ? 0.35 : 0.25) * board.side_m();
  BoardOptions nearby = options;
  nearby.search_sides = board.columns > 2 ? 0.6 : 0.4;
  const double crop_m = (nearby.search_sides + 0.85) * board.side_m();
  const int reach = static_cast<int>(std::ceil(crop_m / cube_m));
  for (const Eigen::Vector3d& place : places_to_try(board, cloud, index, cube_m)) {
    if (tried.size() >= most_tries) break;
    if (is_near(tried, place, apart_m) || is_near(centres, place, 0.75 * board.side_m())) continue;
    tried.push_back(place);
    const Cloud crop = subset(cloud, index.points_of(index.around(place, reach)));
    std::optional<Eigen::Vector3d> rays;
    if (options.along_rays) rays = scanner;
    const auto one =
        measure_points(board_points(crop, place, crop_m, rays), scanner - place, nearby);
    if (!one || is_near(centres, one->centre_m, 0.5 * board.side_m())) continue;
    centres.push_back(one->centre_m);
    found.push_back(*one);
  }
  if (found.empty())
    return Refusal{RefusalCode::no_target,
                   fmt::format("no {} x {} checkerboard of {:.4f} m found; check --side and "
                               "--squares, or give --near",
                               board.columns, board.rows, board.side_m())};
  const auto score = [](const BoardMeasurement& m) {
    return m.colour_score * static_cast<double>(m.points);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto& a, const auto& b) { return score(a) > score(b); });
  return found;
}

}  // namespace alea
