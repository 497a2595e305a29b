#include "alea/checkerboard/board_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alea/checkerboard/board_crop.hpp"
#include "alea/checkerboard/saddle_search.hpp"
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
  if (!cloud.empty()) {
    const CubeIndex index(cloud, cube_m);
    const std::vector<Saddle> saddles =
        find_saddles(index, cube_m, 0.9 * board.cell_m, 0.15 * intensity_range(cloud), 0.25);
    constexpr std::size_t most_tries = 300;
    std::vector<Eigen::Vector3d> tried, centres;
    BoardOptions nearby = options;
    // A saddle of a larger board is any of its inner corners.
    nearby.search_sides = board.columns > 2 ? 0.6 : 0.4;
    const double crop_m = (nearby.search_sides + 0.85) * board.side_m();
    const int reach = static_cast<int>(std::ceil(crop_m / cube_m));
    for (const Saddle& saddle : saddles) {
      if (tried.size() >= most_tries) break;
      if (is_near(tried, saddle.place_m, 0.25 * board.side_m()) ||
          is_near(centres, saddle.place_m, 0.75 * board.side_m()))
        continue;
      tried.push_back(saddle.place_m);
      const Cloud crop = subset(cloud, index.points_of(index.around(saddle.place_m, reach)));
      std::optional<Eigen::Vector3d> rays;
      if (options.along_rays) rays = scanner;
      const BoardPoints points = board_points(crop, saddle.place_m, crop_m, rays);
      const auto one = measure_points(points, scanner - saddle.place_m, nearby);
      if (!one || is_near(centres, one->centre_m, 0.5 * board.side_m())) continue;
      centres.push_back(one->centre_m);
      found.push_back(*one);
    }
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
