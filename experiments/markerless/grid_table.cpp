#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "alea/report/axes.hpp"
#include "experiments/markerless/grid_study.hpp"

namespace alea::experiments::markerless {
namespace {

struct StartName {
  GridStart start;
  const char* name;
};
constexpr std::array<StartName, 3> starts{
    {{GridStart::identity, "paper's ICP from identity"},
     {GridStart::near_truth, "paper's ICP from 3 deg, 0.23 m"},
     {GridStart::robust, "robust method"}}};

std::vector<double> cells_of(const std::vector<GridTrial>& trials) {
  std::vector<double> cells;
  for (const GridTrial& trial : trials)
    if (std::find(cells.begin(), cells.end(), trial.cell_m) == cells.end())
      cells.push_back(trial.cell_m);
  std::sort(cells.begin(), cells.end());
  return cells;
}

template <typename Figure>
std::vector<double> values_of(const std::vector<GridTrial>& trials, double cell_m, GridStart start,
                              Figure&& figure) {
  std::vector<double> values;
  for (const GridTrial& trial : trials)
    if (trial.cell_m == cell_m && trial.start == start)
      values.push_back(static_cast<double>(figure(trial)));
  return values;
}

double rotation_of(const GridTrial& trial) {
  return trial.error.rotation_deg;
}
double translation_of(const GridTrial& trial) {
  return trial.error.translation_m;
}
double rmse_of_trial(const GridTrial& trial) {
  return trial.rmse_m;
}

void add_cells(const std::vector<GridTrial>& trials, double cell_m, const StartName& start,
               std::vector<Cell>& cells) {
  const auto values = [&](auto&& figure) { return values_of(trials, cell_m, start.start, figure); };
  const std::vector<double> rotation = values(rotation_of);
  if (rotation.empty()) return;
  const std::string row = fmt::format("{} m, {}", cell_m, start.name);
  cells.push_back(own_cell(row, "rotation error", "deg", rotation));
  cells.back().note = fmt::format("n = {}", rotation.size());
  cells.push_back(own_cell(row, "translation error", "m", values(translation_of)));
  // The robust method's is along the normals of the points that agree: another figure.
  if (start.start != GridStart::robust)
    cells.push_back(own_cell(row, "RMSE", "m", values(rmse_of_trial)));
}

/// A figure of the widest grid over that of the finest, medians.
double growth(const std::vector<GridTrial>& trials, GridStart start,
              double (*figure)(const GridTrial&)) {
  const std::vector<double> cells = cells_of(trials);
  const auto median = [&](double cell_m) {
    return central_interval(values_of(trials, cell_m, start, figure)).median;
  };
  return median(cells.back()) / median(cells.front());
}

struct Panel {
  const char* title;
  const char* unit;
  double (*figure)(const GridTrial&);
  bool is_log;
  std::size_t starts;
  double at(double value) const { return is_log ? std::log10(value) : value; }
};
constexpr std::array<Panel, 3> panels{
    {{"RMSE of all pairs of ICP", "RMSE (m)", rmse_of_trial, false, 2},
     {"true rotation error", "log10 of degrees", rotation_of, true, 3},
     {"true translation error", "log10 of metres", translation_of, true, 3}}};

void draw_panel(Canvas& canvas, const PanelArea& area, const Panel& panel,
                const std::vector<GridTrial>& trials) {
  std::array<std::vector<Eigen::Vector2d>, 3> points, medians;
  AxesOptions options;
  options.low.y() = panel.is_log ? 1e9 : 0;
  options.high = {0.11, -1e9};
  for (std::size_t s = 0; s < panel.starts; ++s)
    for (const double cell_m : cells_of(trials)) {
      const auto values = values_of(trials, cell_m, starts[s].start, panel.figure);
      for (const double value : values) {
        points[s].emplace_back(cell_m, panel.at(value));
        options.low.y() = std::min(options.low.y(), points[s].back().y() - 0.1);
        options.high.y() = std::max(options.high.y(), points[s].back().y() + 0.1);
      }
      if (!values.empty())
        medians[s].emplace_back(cell_m, panel.at(central_interval(values).median));
    }
  options.title = panel.title;
  options.x_name = "grid (m)";
  options.y_name = panel.unit;
  options.equal_scale = false;
  Axes axes(canvas, area, options);
  for (std::size_t s = 0; s < panel.starts; ++s) {
    axes.points(points[s], colours::categorical(s), 3);
    axes.polyline(medians[s], colours::categorical(s), 2);
  }
}

}  // namespace

ResultTable grid_table(const std::vector<GridTrial>& trials) {
  ResultTable table{"grids",
                    "Grid size against accuracy, ST1-ST2 of the bell tower's twin, both ways",
                    "The paper's second aim; it judges accuracy by RMSE.",
                    {}};
  for (const double cell_m : cells_of(trials)) {
    const std::string row = fmt::format("{} m", cell_m);
    const auto points = [](const GridTrial& t) { return t.points; };
    table.cells.push_back(
        own_cell(row, "moving points", "", values_of(trials, cell_m, GridStart::identity, points)));
    table.cells.push_back(
        own_cell(row, "RMSE at the truth", "m",
                 values_of(trials, cell_m, GridStart::identity,
                           [](const GridTrial& t) { return t.rmse_at_truth_m; })));
    for (const StartName& start : starts) add_cells(trials, cell_m, start, table.cells);
  }
  const double rmse = growth(trials, GridStart::near_truth, rmse_of_trial);
  const double rotation = growth(trials, GridStart::near_truth, rotation_of);
  const double translation = growth(trials, GridStart::near_truth, translation_of);
  const auto add = [&](const char* what, double value, bool agrees, const char* note) {
    table.cells.push_back({"widest over finest grid, near the truth", what, "", "about 1",
                           Interval{value, value, value},
                           agrees ? Verdict::agrees : Verdict::differs, note});
  };
  const auto is_small = [](double ratio) { return ratio > 0.5 && ratio < 2; };
  add("RMSE", rmse, is_small(rmse), "the text quotes 'no big influence' of the grid on accuracy");
  add("rotation error", rotation, is_small(rotation), "what the true pose says of the same");
  add("translation error", translation, is_small(translation), "");
  return table;
}

void draw_grids(const std::vector<GridTrial>& trials, const std::string& folder,
                const std::string& name) {
  Canvas canvas(1500, 560);
  for (std::size_t p = 0; p < panels.size(); ++p)
    draw_panel(canvas, {500 * static_cast<double>(p), 0, 500, 510}, panels[p], trials);
  std::vector<std::pair<std::string, Rgb>> entries;
  for (std::size_t s = 0; s < starts.size(); ++s)
    entries.emplace_back(starts[s].name, colours::categorical(s));
  draw_legend_row(canvas, {320, 535}, entries);
  write_png(std::filesystem::path(folder) / (name + ".png"), canvas.picture());
}

}  // namespace alea::experiments::markerless
