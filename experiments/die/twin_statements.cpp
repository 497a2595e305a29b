#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "alea/core/angle.hpp"
#include "experiments/die/statements.hpp"

namespace alea::experiments::die {
namespace {

using TwinValue = std::function<std::optional<double>(const TwinOutcome&)>;

std::vector<double> collect(const std::vector<TwinOutcome>& twins, const TwinValue& value) {
  std::vector<double> values;
  for (const TwinOutcome& outcome : twins)
    if (const auto one = value(outcome)) values.push_back(*one);
  return values;
}

// "Less than": holds where our whole central 95 % does.
Cell bound_cell(const std::string& row, const std::string& column, const std::string& unit,
                double limit, const std::string& printed, const std::vector<double>& values) {
  if (values.empty())
    return {row, column, unit, printed, std::nullopt, Verdict::differs, "refused"};
  Cell cell = own_cell(row, column, unit, values);
  cell.printed = printed;
  cell.verdict = cell.ours->high < limit ? Verdict::agrees : Verdict::differs;
  const auto holds =
      std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; });
  cell.note = fmt::format("holds for {:.0f} % of {} twins",
                          100.0 * static_cast<double>(holds) / static_cast<double>(values.size()),
                          values.size());
  return cell;
}

// "Within 0.5 mm of spheres": the largest difference over the four check planes.
void add_sphere_cells(const std::string& dataset, const std::vector<TwinOutcome>& twins,
                      std::vector<Cell>& cells) {
  struct Reading {
    const char* name;
    TwinMethod method;
  };
  for (const Reading& reading :
       {Reading{"equations 1-8", TwinMethod::paper_check},
        Reading{"nearest reading", TwinMethod::nearest_check},
        Reading{"closed form, other planes", TwinMethod::closed_form_independent}}) {
    for (const TwinMethod spheres : {TwinMethod::spheres_six, TwinMethod::spheres_four}) {
      const auto values = collect(twins, [&](const TwinOutcome& t) -> std::optional<double> {
        const MethodOutcome &die = t.of(reading.method), &ball = t.of(spheres);
        if (!die.registered || !ball.registered) return std::nullopt;
        double largest = 0;
        for (std::size_t k = 0; k < die.union_m.size(); ++k)
          largest = std::max(largest, std::abs(die.union_m[k] - ball.union_m[k]));
        return 1e3 * largest;
      });
      cells.push_back(
          bound_cell("dataset " + dataset,
                     fmt::format("RMSE within 0.5 mm of {} spheres: {}",
                                 spheres == TwinMethod::spheres_six ? "six" : "four", reading.name),
                     "mm", 0.5, "<0.5", values));
    }
  }
}

// "The method will never suffer from weak geometry": the rotation against that of six spheres.
void add_geometry_cell(const std::string& dataset, const std::vector<TwinOutcome>& twins,
                       std::vector<Cell>& cells) {
  double die = 0, spheres = 0;
  for (const TwinOutcome& t : twins) {
    die += std::pow(t.of(TwinMethod::closed_form_independent).rotation_rad, 2);
    spheres += std::pow(t.of(TwinMethod::spheres_six).rotation_rad, 2);
  }
  const double ratio = std::sqrt(die / spheres);
  cells.push_back({"dataset " + dataset, "never weak geometry: RMS rotation, die over six spheres",
                   "", "<=1", Interval{ratio, ratio, ratio},
                   ratio <= 1 ? Verdict::agrees : Verdict::differs,
                   "closed form; three points at unit length carry no redundancy"});
}

// "The check plane succeeds the larger RMSE": how far a perfect registration's union lies below the
// larger of the two, as a share of what they differ by; a pooled RMSE lies half way.
void add_inheritance_cell(const std::string& dataset, const std::vector<TwinOutcome>& twins,
                          std::vector<Cell>& cells) {
  std::vector<double> shares;
  for (const TwinOutcome& t : twins)
    for (std::size_t k = 0; k < t.planes.size(); ++k) {
      const auto [smaller, larger] =
          std::minmax(t.planes[k].alone_master_m, t.planes[k].alone_slave_m);
      if (larger - smaller > 5e-5)
        shares.push_back((larger - t.of(TwinMethod::perfect).union_m[k]) / (larger - smaller));
    }
  if (shares.empty()) return;
  Cell cell = own_cell("dataset " + dataset,
                       "inherits the larger RMSE: union below the larger, share of the difference",
                       "", shares);
  cell.printed = std::string("0");
  cell.verdict = cell.ours->low > 0.05 ? Verdict::differs : Verdict::agrees;
  cell.note = "a perfect registration inherits the pooled RMSE";
  cells.push_back(cell);
}

// "The calibration need not be repeated": A's length on B and C, the same die.
void add_borrowed_cells(const std::string& dataset, const std::vector<TwinOutcome>& twins,
                        std::vector<Cell>& cells) {
  const auto worst_excess = [](const TwinOutcome& t) -> std::optional<double> {
    const MethodOutcome &borrowed = t.of(TwinMethod::closed_form_borrowed),
                        &own = t.of(TwinMethod::closed_form_independent);
    if (!borrowed.registered || !own.registered) return std::nullopt;
    double worst = 0;
    for (std::size_t k = 0; k < own.union_m.size(); ++k)
      worst = std::max(worst, borrowed.union_m[k] - own.union_m[k]);
    return 1e3 * worst;
  };
  cells.push_back(
      bound_cell("dataset " + dataset,
                 "no need to repeat the calibration: RMSE added by A's length, worst plane", "mm",
                 0.1, "0", collect(twins, worst_excess)));
}

// Horizontal planes cannot see a horizontal length; the print says that they do.
void add_horizontal_cell(const std::string& dataset, const std::vector<TwinOutcome>& twins,
                         std::vector<Cell>& cells) {
  std::vector<double> gain;
  for (const TwinOutcome& t : twins) {
    const MethodOutcome &before = t.of(TwinMethod::closed_form_nominal),
                        &after = t.of(TwinMethod::closed_form_check);
    if (!before.registered || !after.registered) continue;
    for (std::size_t k = 0; k < t.planes.size(); ++k)
      if (!t.planes[k].vertical) gain.push_back(1e3 * (before.union_m[k] - after.union_m[k]));
  }
  if (gain.empty()) return;
  Cell cell = own_cell("dataset " + dataset,
                       "horizontal planes gain by calibrating horizontal lengths", "mm", gain);
  cell.printed = "2.48";
  cell.verdict = cell.ours->high < 2.475 ? Verdict::differs : Verdict::agrees;
  cell.note = "printed: mean over all datasets; equation 7 has no vertical length";
  cells.push_back(cell);
}

// Means over the printed rows of Tables 2 to 5, twin by twin, against the printed means.
void add_mean_cells(const PublishedTables& tables, const TwinRuns& runs, std::vector<Cell>& cells) {
  struct Reading {
    const char* name;
    std::string PublishedCheckPlane::*printed;
    TwinMethod method;
  };
  const std::vector<Reading> readings{
      {"uncalibrated, equations 1-8", &PublishedCheckPlane::uncalibrated_mm,
       TwinMethod::paper_nominal},
      {"uncalibrated, nearest reading", &PublishedCheckPlane::uncalibrated_mm,
       TwinMethod::nearest_nominal},
      {"calibrated, equations 1-8", &PublishedCheckPlane::calibrated_mm, TwinMethod::paper_check},
      {"calibrated, nearest reading", &PublishedCheckPlane::calibrated_mm,
       TwinMethod::nearest_check}};
  for (const Reading& reading : readings) {
    for (const bool vertical : {true, false}) {
      std::vector<double> sums(runs.begin()->second.size(), 0.0);
      double printed = 0, count = 0;
      std::map<std::string, std::size_t> plane_of_dataset;
      for (const PublishedCheckPlane& row : tables.check_planes) {
        const std::size_t plane = plane_of_dataset[row.dataset]++;
        if (row.vertical != vertical || (row.*reading.printed).empty()) continue;
        printed += parse_printed(row.*reading.printed).value;
        ++count;
        const std::vector<TwinOutcome>& twins = runs.at(row.dataset);
        for (std::size_t i = 0; i < sums.size(); ++i)
          sums[i] += twins[i].of(reading.method).registered
                         ? 1e3 * twins[i].of(reading.method).union_m[plane]
                         : std::nan("");
      }
      std::vector<PriorSample> samples;
      for (const double sum : sums)
        if (std::isfinite(sum)) samples.push_back({sum / count, {}});
      if (samples.empty()) continue;
      cells.push_back(judged_cell(vertical ? "vertical planes" : "horizontal planes",
                                  std::string("mean RMSE of the printed rows, ") + reading.name,
                                  "mm", fmt::format("{:.2f}", printed / count), samples, {}));
    }
  }
}

void add_rotation_cells(const std::string& dataset, const std::vector<TwinOutcome>& twins,
                        std::vector<Cell>& cells) {
  struct Reading {
    const char* name;
    TwinMethod method;
  };
  for (const Reading& reading : {Reading{"equations 1-8", TwinMethod::paper_nominal},
                                 Reading{"nearest reading", TwinMethod::nearest_nominal},
                                 Reading{"closed form", TwinMethod::closed_form_nominal},
                                 Reading{"six spheres", TwinMethod::spheres_six}}) {
    const auto angles = collect(twins, [&](const TwinOutcome& t) -> std::optional<double> {
      if (!t.of(reading.method).registered) return std::nullopt;
      return t.of(reading.method).rotation_rad / deg;
    });
    if (!angles.empty())
      cells.push_back(own_cell("dataset " + dataset,
                               std::string("true rotation error, ") + reading.name, "deg", angles));
  }
}

}  // namespace

ResultTable twin_statements(const PublishedTables& tables, const TwinRuns& runs) {
  ResultTable table{"statements", "Statements of the text against the twins", "", {}};
  table.note = fmt::format("{} twins of each dataset", runs.begin()->second.size());
  add_mean_cells(tables, runs, table.cells);
  for (const auto& [dataset, twins] : runs) {
    add_sphere_cells(dataset, twins, table.cells);
    add_geometry_cell(dataset, twins, table.cells);
    add_inheritance_cell(dataset, twins, table.cells);
    add_horizontal_cell(dataset, twins, table.cells);
    if (dataset == "B" || dataset == "C") add_borrowed_cells(dataset, twins, table.cells);
    add_rotation_cells(dataset, twins, table.cells);
  }
  return table;
}

}  // namespace alea::experiments::die
