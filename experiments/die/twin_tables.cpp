#include "experiments/die/twin_tables.hpp"

#include <fmt/format.h>

#include <functional>

#include "alea/core/angle.hpp"

namespace alea::experiments::die {
namespace {

// Values (mm) of one check plane over the twins.
using PlaneValue = std::function<std::optional<double>(const TwinOutcome&, std::size_t plane)>;

PlaneValue union_of(TwinMethod method) {
  return [method](const TwinOutcome& outcome, std::size_t plane) -> std::optional<double> {
    const MethodOutcome& result = outcome.of(method);
    if (!result.registered) return std::nullopt;
    return 1e3 * result.union_m[plane];
  };
}

// A cell judged by what is printed, or one of our own where the print has nothing.
Cell plane_cell(const std::vector<TwinOutcome>& twins, std::size_t plane, const std::string& column,
                const std::string& printed, const PlaneValue& value) {
  std::vector<PriorSample> samples;
  std::vector<double> values;
  for (const TwinOutcome& outcome : twins) {
    const std::optional<double> one = value(outcome, plane);
    if (!one) continue;
    samples.push_back({*one, omitted_draws(outcome, plane)});
    values.push_back(*one);
  }
  const std::string& row = twins.front().planes[plane].name;
  if (values.empty()) return {row, column, "mm", printed, std::nullopt, Verdict::ours, "refused"};
  Cell cell = printed.empty() ? own_cell(row, column, "mm", std::move(values))
                              : judged_cell(row, column, "mm", printed, samples, omitted_data());
  const std::size_t refused = twins.size() - samples.size();
  if (refused > 0) cell.note += fmt::format("; {} of {} twins refused", refused, twins.size());
  return cell;
}

struct Column {
  std::string name;
  std::string PublishedCheckPlane::*printed;  ///< null: our own
  TwinMethod method;
};

const std::vector<Column>& union_columns() {
  static const std::vector<Column> columns{
      {"uncalibrated, equations 1-8", &PublishedCheckPlane::uncalibrated_mm,
       TwinMethod::paper_nominal},
      {"uncalibrated, nearest reading", &PublishedCheckPlane::uncalibrated_mm,
       TwinMethod::nearest_nominal},
      {"uncalibrated, closed form", nullptr, TwinMethod::closed_form_nominal},
      {"calibrated on these planes, equations 1-8", &PublishedCheckPlane::calibrated_mm,
       TwinMethod::paper_check},
      {"calibrated on these planes, nearest reading", &PublishedCheckPlane::calibrated_mm,
       TwinMethod::nearest_check},
      {"calibrated on other planes, equations 1-8", nullptr, TwinMethod::paper_independent},
      {"calibrated on other planes, nearest reading", nullptr, TwinMethod::nearest_independent},
      {"calibrated on other planes, closed form", nullptr, TwinMethod::closed_form_independent},
      {"six spheres", &PublishedCheckPlane::spheres_mm, TwinMethod::spheres_six},
      {"four spheres", nullptr, TwinMethod::spheres_four},
      {"perfect registration", nullptr, TwinMethod::perfect}};
  return columns;
}

std::string twins_note(std::size_t count) {
  return fmt::format(
      "Ours: median [central 95 %] over {} twins, each with its own die and draw of what the paper "
      "omits.",
      count);
}

Cell input_cell(const std::string& row, const std::string& column, const std::string& unit,
                const std::string& printed, std::vector<double> ours) {
  Cell cell = own_cell(row, column, unit, std::move(ours));
  cell.printed = printed;
  cell.verdict = Verdict::input;
  return cell;
}

template <typename Value>
std::vector<double> values_of(const std::vector<TwinOutcome>& twins, Value value) {
  std::vector<double> values;
  for (const TwinOutcome& outcome : twins) values.push_back(value(outcome));
  return values;
}

void add_edge_cells(const std::vector<TwinOutcome>& twins, const PublishedDie& die,
                    std::vector<Cell>& cells) {
  struct Reading {
    const char* name;
    TwinMethod method;
    bool judged;
  };
  for (const Reading& reading :
       {Reading{"calibrated edge, equations 1-8, check planes", TwinMethod::paper_check, true},
        Reading{"calibrated edge, nearest reading, check planes", TwinMethod::nearest_check, true},
        Reading{"calibrated edge, closed form, other planes", TwinMethod::closed_form_independent,
                false}}) {
    std::vector<PriorSample> samples;
    std::vector<double> values;
    for (const TwinOutcome& outcome : twins) {
      if (!outcome.of(reading.method).registered) continue;
      values.push_back(outcome.of(reading.method).edge_m);
      samples.push_back({values.back(), omitted_draws(outcome, 0)});
    }
    if (values.empty()) continue;
    Cell cell = reading.judged ? judged_cell(die.dataset, reading.name, "m", die.calibrated_edge_m,
                                             samples, omitted_data())
                               : own_cell(die.dataset, reading.name, "m", values);
    if (!reading.judged) cell.note = "the twins' true edge is " + die.calibrated_edge_m;
    cells.push_back(cell);
  }
}

}  // namespace

const std::vector<std::string>& omitted_data() {
  static const std::vector<std::string> names{"azimuth of the master station",
                                              "azimuth of the slave station", "scanner height",
                                              "direction of the plane", "noise at the plane"};
  return names;
}

std::vector<double> omitted_draws(const TwinOutcome& outcome, std::size_t plane) {
  return {outcome.azimuth_rad[0], outcome.azimuth_rad[1], outcome.scanner_height_m,
          outcome.planes[plane].along_edge, outcome.planes[plane].noise_scale};
}

ResultTable twin_table1(const PublishedTables& tables, const TwinRuns& runs) {
  ResultTable table{"table1", "Table 1: the datasets", "", {}};
  table.note = twins_note(runs.begin()->second.size());
  for (const PublishedScan& scan : tables.scans) {
    const std::vector<TwinOutcome>& twins = runs.at(scan.dataset);
    const auto k = static_cast<std::size_t>(scan.cloud - 1);
    const std::string row = fmt::format("{}-{}", scan.dataset, scan.cloud);
    table.cells.push_back(input_cell(
        row, "points on the die", "", scan.points,
        values_of(twins, [&](const auto& t) { return static_cast<double>(t.die_points[k]); })));
    table.cells.push_back(
        own_cell(row, "angular step implied", "mrad",
                 values_of(twins, [&](const auto& t) { return 1e3 * t.step_rad[k]; })));
    table.cells.push_back(
        own_cell(row, "spacing implied", "mm", values_of(twins, [&](const auto& t) {
                   return 1e3 * t.step_rad[k] * scan.scanner_to_die_m;
                 })));
  }
  return table;
}

ResultTable twin_check_plane_table(const PublishedTables& tables, const TwinRuns& runs,
                                   const std::string& dataset) {
  const std::vector<TwinOutcome>& twins = runs.at(dataset);
  const int number = 2 + (dataset.front() - 'A');
  ResultTable table{fmt::format("table{}", number),
                    fmt::format("Table {}: RMSE of the check planes, dataset {}", number, dataset),
                    twins_note(twins.size()),
                    {}};
  std::size_t plane = 0;
  for (const PublishedCheckPlane& row : tables.check_planes) {
    if (row.dataset != dataset) continue;
    table.cells.push_back(plane_cell(
        twins, plane, "alone, master", row.before_master_mm,
        [](const TwinOutcome& t, std::size_t k) { return 1e3 * t.planes[k].alone_master_m; }));
    table.cells.push_back(plane_cell(
        twins, plane, "alone, slave", row.before_slave_mm,
        [](const TwinOutcome& t, std::size_t k) { return 1e3 * t.planes[k].alone_slave_m; }));
    for (const Column& column : union_columns())
      table.cells.push_back(plane_cell(twins, plane, column.name,
                                       column.printed == nullptr ? "" : row.*column.printed,
                                       union_of(column.method)));
    ++plane;
  }
  return table;
}

ResultTable twin_table6(const PublishedTables& tables, const TwinRuns& runs) {
  ResultTable table{"table6", "Table 6: angles between facets and calibrated edges", "", {}};
  table.note = twins_note(runs.begin()->second.size());
  for (const PublishedDie& die : tables.dice) {
    const std::vector<TwinOutcome>& twins = runs.at(die.dataset);
    const std::string row = fmt::format("{}-{}", die.dataset, die.cloud);
    const auto scan = static_cast<std::size_t>(die.cloud - 1);
    const std::array<std::string, 3> printed{die.angle_xy_deg, die.angle_xz_deg, die.angle_yz_deg};
    const std::array<const char*, 3> names{"angle XY", "angle XZ", "angle YZ"};
    for (std::size_t k = 0; k < 3; ++k)
      table.cells.push_back(
          input_cell(row, names[k], "deg", printed[k],
                     values_of(twins, [&](const auto& t) { return t.angles_rad[scan][k] / deg; })));
    if (die.cloud == 2) add_edge_cells(twins, die, table.cells);
  }
  return table;
}

}  // namespace alea::experiments::die
