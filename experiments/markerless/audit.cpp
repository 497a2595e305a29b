#include "experiments/markerless/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "alea/core/angle.hpp"
#include "experiments/markerless/rank_correlation.hpp"

namespace alea::experiments::markerless {
namespace {

Cell statement(const std::string& row, const std::string& column, const std::string& unit,
               const std::string& printed, double ours, Verdict verdict, const std::string& note) {
  return {row, column, unit, printed, Interval{ours, ours, ours}, verdict, note};
}

struct Column {
  const char* name;
  double PublishedPair::*value;
};
const std::array<Column, 8> columns{{{"omega", &PublishedPair::omega_deg},
                                     {"phi", &PublishedPair::phi_deg},
                                     {"kappa", &PublishedPair::kappa_deg},
                                     {"Tx", &PublishedPair::tx_m},
                                     {"Ty", &PublishedPair::ty_m},
                                     {"Tz", &PublishedPair::tz_m},
                                     {"overlap", &PublishedPair::overlap_percent},
                                     {"RMSE", &PublishedPair::rmse_m}}};

/// The rows of a table whose fixed (or moving) station is the reference.
std::vector<PublishedPair> block(const std::vector<PublishedPair>& table, bool forward) {
  const std::string reference = table.front().fixed;
  std::vector<PublishedPair> rows;
  for (const PublishedPair& pair : table)
    if ((pair.fixed == reference) == forward) rows.push_back(pair);
  return rows;
}

std::vector<double> values_of(const std::vector<PublishedPair>& rows,
                              double PublishedPair::*member) {
  std::vector<double> values;
  for (const PublishedPair& row : rows) values.push_back(row.*member);
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void audit_averages(const std::string& name, const std::vector<PublishedPair>& table,
                    const std::vector<PublishedAverage>& averages, std::vector<Cell>& cells) {
  for (std::size_t b = 0; b < averages.size(); ++b) {
    const std::vector<PublishedPair> rows = block(table, b == 0);
    double largest = 0;
    int agree = 0;
    for (const Column& column : columns) {
      const double off =
          std::abs(mean(values_of(rows, column.value)) - averages[b].values.*column.value);
      largest = std::max(largest, off);
      if (off <= 0.001) ++agree;  // half a digit of the mean and of its rows
    }
    cells.push_back(statement(name + ", " + averages[b].block, "averages that agree", "of 8", "8",
                              agree, agree == 8 ? Verdict::agrees : Verdict::differs,
                              fmt::format("largest difference {:.4f}", largest)));
    double absolute = 0;
    for (const PublishedPair& row : rows)
      absolute += std::abs(row.kappa_deg) / static_cast<double>(rows.size());
    cells.push_back(statement(name + ", " + averages[b].block, "mean |kappa|", "deg",
                              fmt::format("{:.3f}", averages[b].values.kappa_deg), absolute,
                              Verdict::differs,
                              "the printed mean is of signed angles: they cancel"));
  }
}

void audit_closures(const std::string& name, const std::vector<PublishedPair>& table,
                    std::vector<Cell>& cells) {
  const std::array<std::pair<Convention, const char*>, 4> all{
      {{Convention::equation_3, "equation 3"},
       {Convention::transposed, "transposed"},
       {Convention::reversed_order, "reversed order"},
       {Convention::reversed_transposed, "reversed, transposed"}}};
  for (const auto& [convention, words] : all) {
    int consistent = 0;
    const auto closures = misclosures(table, convention);
    for (const Misclosure& m : closures)
      if (m.rotation_deg < 1 && m.translation_m < 0.1) ++consistent;
    cells.push_back(statement(name, fmt::format("pairs that close, {}", words), "",
                              fmt::format("{}", closures.size()), consistent,
                              consistent == 0 ? Verdict::differs : Verdict::agrees,
                              "forward times reverse within 1 deg and 0.1 m"));
  }
  const auto straight = misclosures(table, Convention::equation_3);
  const auto turned = misclosures(table, Convention::transposed);
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const bool first = straight[i].translation_m <= turned[i].translation_m;
    const Misclosure& better = first ? straight[i] : turned[i];
    cells.push_back(statement(better.pair, "forward times reverse, rotation", "deg", "0",
                              better.rotation_deg, Verdict::differs,
                              first ? "as equation 3" : "transposed"));
    cells.push_back(statement(better.pair, "forward times reverse, translation", "m", "0",
                              better.translation_m, Verdict::differs, ""));
  }
}

void audit_counts(const PublishedTables& tables, std::vector<Cell>& cells) {
  for (const PublishedGrid& row : tables.grids)
    cells.push_back(statement(
        row.station, "fall of the counts, 0.025 to 0.05 m", "", "", row.points_025 / row.points_050,
        Verdict::ours, "a surface falls by 4 where the grid decides, less where density does"));
  const PublishedGrid& first = tables.grids.front();
  const PublishedSampling& grid = tables.sampling.at(1);
  cells.push_back(statement(first.station, "fall of the counts, 0.05 to 0.1 m", "", "",
                            first.points_050 / grid.fixed_points, Verdict::differs,
                            "more than a surface can lose (4); a volume loses 8"));
  const double left =
      std::max(std::abs(first.points_010 - tables.sampling[0].fixed_points),
               std::abs(tables.grids[1].points_010 - tables.sampling[0].moving_points));
  cells.push_back(statement("ST1, ST2", "points lost by the 0.01 m grid", "", "", left,
                            Verdict::differs, "none: the column is the raw scan"));
  const double leaves = tables.sampling.at(3).moving_points;
  cells.push_back(statement(
      "Table 1", "non-uniform grid: levels of halving", "", "", std::log2(leaves), Verdict::ours,
      fmt::format("{:.2f} points a leaf", tables.sampling[3].fixed_points > 0
                                              ? tables.sampling[0].moving_points / leaves
                                              : 0)));
  cells.push_back(statement("Table 1", "RMSE of the grid over that of all points", "", "2",
                            grid.rmse_m / tables.sampling[0].rmse_m, Verdict::differs,
                            "'almost two times'"));
}

void audit_correlations(const std::string& name, const std::vector<PublishedPair>& table,
                        std::vector<Cell>& cells) {
  for (const bool forward : {true, false}) {
    const std::vector<PublishedPair> rows = block(table, forward);
    std::vector<double> distance;
    for (const PublishedPair& row : rows)
      distance.push_back(Eigen::Vector3d(row.tx_m, row.ty_m, row.tz_m).norm());
    const std::vector<double> rmse = values_of(rows, &PublishedPair::rmse_m);
    const std::string where = name + (forward ? ", one to many" : ", many to one");
    const auto add = [&](const char* what, const RankCorrelation& found) {
      cells.push_back(statement(where, what, "", "", found.rho, Verdict::ours,
                                fmt::format("p = {:.3f}, n = {}", found.p_value, rows.size())));
    };
    add("Spearman RMSE, overlap",
        rank_correlation(rmse, values_of(rows, &PublishedPair::overlap_percent)));
    add("Spearman RMSE, |T|", rank_correlation(rmse, distance));
  }
}

void audit_tilts(const std::string& name, const std::vector<PublishedPair>& table,
                 std::vector<Cell>& cells) {
  double tilt = 0, height = 0;
  int tilted = 0;
  for (const PublishedPair& row : table) {
    const double largest = std::max(std::abs(row.omega_deg), std::abs(row.phi_deg));
    tilt = std::max(tilt, largest);
    height = std::max(height, std::abs(row.tz_m));
    if (largest > 1) ++tilted;
  }
  cells.push_back(statement(
      name, "largest |omega| or |phi|", "deg", "", tilt, Verdict::ours,
      fmt::format("{} of {} pairs tilt a tripod by more than 1 deg", tilted, table.size())));
  cells.push_back(statement(name, "largest |Tz|", "m", "", height, Verdict::ours, ""));
}

/// Equation (4) as printed, atan(r32 / r31), against the angle that made the matrix.
void audit_equations(const PublishedTables& tables, std::vector<Cell>& cells) {
  double largest = 0, correct = 0, least_det = 2;
  for (const auto* table : {&tables.bell_tower, &tables.lighthouse})
    for (const PublishedPair& row : *table) {
      const Eigen::Matrix3d r = published_pose(row, Convention::equation_3).rotation;
      largest = std::max(largest, std::abs(std::atan(r(2, 1) / r(2, 0)) / deg - row.omega_deg));
      correct = std::max(correct, std::abs(std::atan2(r(2, 1), r(2, 2)) / deg - row.omega_deg));
      least_det = std::min(least_det, r.determinant());
    }
  cells.push_back(statement("equation 4", "largest error of omega as printed", "deg", "0", largest,
                            Verdict::differs, "atan(r32 / r31); atan2(r32, r33) is meant"));
  cells.push_back(statement("equation 4", "largest error of omega by atan2(r32, r33)", "deg", "0",
                            correct, Verdict::agrees, ""));
  cells.push_back(statement("equations 1, 2", "scale lambda of a rotation (cube root of det)", "",
                            "", std::cbrt(least_det), Verdict::ours,
                            "1 for rigid ICP; equation 2 is orthogonality, no matching condition"));
}

void audit_captions(const PublishedTables& tables, std::vector<Cell>& cells) {
  const auto by_rmse = [](const PublishedPair& a, const PublishedPair& b) {
    return a.rmse_m < b.rmse_m;
  };
  const auto by_overlap = [](const PublishedPair& a, const PublishedPair& b) {
    return a.overlap_percent < b.overlap_percent;
  };
  const auto& tower = tables.bell_tower;
  const PublishedPair& lowest = *std::min_element(tower.begin(), tower.end(), by_rmse);
  const PublishedPair& highest = *std::max_element(tower.begin(), tower.end(), by_rmse);
  const PublishedPair& widest = *std::max_element(tower.begin(), tower.end(), by_overlap);
  const auto add = [&](const char* figure, const char* what, const PublishedPair& pair,
                       const char* named, double value, const char* note) {
    const std::string name = pair.fixed + "-" + pair.moving;
    cells.push_back(statement(figure, fmt::format("{}: {}", what, name), "", named, value,
                              name == named ? Verdict::agrees : Verdict::differs, note));
  };
  add("Figure 5a", "lowest RMSE", lowest, "ST1-ST3", lowest.rmse_m, "");
  add("Figure 5 (b in the text, c in the caption)", "largest overlap", widest, "ST4-ST1",
      widest.overlap_percent, "caption and text swap b and c");
  add("Figure 5 (c in the text, b in the caption)", "highest RMSE", highest, "ST8-ST1",
      highest.rmse_m, "");
}

}  // namespace

RigidTransform published_pose(const PublishedPair& pair, Convention convention) {
  const Eigen::Vector3d angles =
      deg * Eigen::Vector3d(pair.omega_deg, pair.phi_deg, pair.kappa_deg);
  const bool reversed =
      convention == Convention::reversed_order || convention == Convention::reversed_transposed;
  // Rx(w) Ry(p) Rz(k) is the transpose of Rz(-k) Ry(-p) Rx(-w).
  const Eigen::Matrix3d r =
      reversed ? Eigen::Matrix3d(rotation_from_omega_phi_kappa(-angles).transpose())
               : rotation_from_omega_phi_kappa(angles);
  const bool transposed =
      convention == Convention::transposed || convention == Convention::reversed_transposed;
  return {transposed ? Eigen::Matrix3d(r.transpose()) : r, {pair.tx_m, pair.ty_m, pair.tz_m}};
}

std::vector<Misclosure> misclosures(const std::vector<PublishedPair>& table,
                                    Convention convention) {
  std::vector<Misclosure> found;
  for (const PublishedPair& forward : block(table, true))
    for (const PublishedPair& reverse : block(table, false)) {
      if (reverse.fixed != forward.moving) continue;
      const RigidTransform around =
          published_pose(forward, convention) * published_pose(reverse, convention);
      found.push_back({forward.fixed + "-" + forward.moving,
                       rotation_angle_rad(around.rotation) / deg, around.translation.norm()});
    }
  return found;
}

ResultTable audit_published(const PublishedTables& tables) {
  ResultTable audit{"audit",
                    "The published tables against themselves and against the text",
                    "Computed from the printed numbers alone; nothing is simulated.",
                    {}};
  audit_averages("Table 3", tables.bell_tower, tables.tower_averages, audit.cells);
  audit_averages("Table 4", tables.lighthouse, tables.lighthouse_averages, audit.cells);
  audit_closures("Table 3", tables.bell_tower, audit.cells);
  audit_closures("Table 4", tables.lighthouse, audit.cells);
  audit_counts(tables, audit.cells);
  audit_correlations("Table 3", tables.bell_tower, audit.cells);
  audit_correlations("Table 4", tables.lighthouse, audit.cells);
  audit_tilts("Table 3", tables.bell_tower, audit.cells);
  audit_tilts("Table 4", tables.lighthouse, audit.cells);
  audit_equations(tables, audit.cells);
  audit_captions(tables, audit.cells);
  return audit;
}

}  // namespace alea::experiments::markerless
