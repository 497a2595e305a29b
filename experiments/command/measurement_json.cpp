#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "experiments/command/measure.hpp"

namespace alea::command {
namespace {

constexpr double smallest_side_m = 0.01, largest_side_m = 20;

nlohmann::json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

nlohmann::json json_of(const std::optional<Eigen::Matrix3d>& m) {
  if (!m) return nullptr;
  nlohmann::json rows = nlohmann::json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({(*m)(r, 0), (*m)(r, 1), (*m)(r, 2)});
  return rows;
}

nlohmann::json json_of(const BoardAxes& axes) {
  return {json_of(Eigen::Vector3d(axes.col(0))), json_of(Eigen::Vector3d(axes.col(1)))};
}

}  // namespace

void add_board_options(CLI::App& app, BoardArguments& arguments) {
  app.add_option("--side", arguments.side_m,
                 "Longer side of the checkerboard (m): its columns times the side of one cell")
      ->required();
  app.add_option("--squares", arguments.squares, "Cells: COLSxROWS")->capture_default_str();
}

BoardSpec board_spec(const BoardArguments& arguments) {
  if (!(arguments.side_m >= smallest_side_m && arguments.side_m <= largest_side_m))
    throw usage_error(
        fmt::format("--side: {} m is not the side of a checkerboard; give metres from {} to {}",
                    arguments.side_m, smallest_side_m, largest_side_m));
  int columns = 0, rows = 0, used = 0;
  const int read = std::sscanf(arguments.squares.c_str(), "%5dx%5d%n", &columns, &rows, &used);
  if (read != 2 || used != static_cast<int>(arguments.squares.size()) || columns < 2 || rows < 2 ||
      columns > 200 || rows > 200)
    throw usage_error(
        fmt::format("--squares: '{}' is not COLSxROWS; give two counts from 2 to 200, e.g. 8x6",
                    arguments.squares));
  BoardSpec board;
  board.columns = std::max(columns, rows);
  board.rows = std::min(columns, rows);
  board.cell_m = arguments.side_m / board.columns;
  return board;
}

BoardOptions board_options(const BoardArguments& arguments) {
  BoardOptions options;
  options.board = board_spec(arguments);
  if (!arguments.origin.empty()) {
    const auto at = parse_point("--origin", arguments.origin);
    options.scanner_position = Eigen::Vector3d((*at)[0], (*at)[1], (*at)[2]);
  }
  return options;
}

nlohmann::json measurement_json(const BoardMeasurement& measurement) {
  nlohmann::json alternatives = nlohmann::json::array();
  for (const BoardAxes& axes : measurement.alternatives) alternatives.push_back(json_of(axes));
  return {{"centre_m", json_of(measurement.centre_m)},
          {"covariance", json_of(measurement.covariance)},
          {"normal", json_of(measurement.normal)},
          {"axes", json_of(measurement.axes)},
          {"alternatives", alternatives},
          {"cell_m", measurement.cell_m},
          {"cell_estimated", measurement.cell_estimated},
          {"rmse_m", measurement.rmse_m},
          {"colour_score", measurement.colour_score},
          {"correlation", measurement.correlation},
          {"bound", json_of(measurement.bound)},
          {"points", measurement.points},
          {"intensity", {{"dark", measurement.dark}, {"light", measurement.light}}},
          {"blur_m", {measurement.blur_m.x(), measurement.blur_m.y()}}};
}

}  // namespace alea::command
