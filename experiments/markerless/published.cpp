#include "experiments/markerless/published.hpp"

#include "experiments/engine/build_info.hpp"
#include "experiments/engine/csv_table.hpp"

namespace alea::experiments::markerless {
namespace {

CsvTable published(const std::string& name) {
  return read_csv(data_dir() + "/experiments/markerless/published/" + name + ".csv");
}

PublishedPair pair_of(const CsvTable& table, std::size_t row) {
  const auto number = [&](const char* name) { return table.number(row, name).value_or(0); };
  PublishedPair pair;
  pair.omega_deg = number("omega_deg");
  pair.phi_deg = number("phi_deg");
  pair.kappa_deg = number("kappa_deg");
  pair.tx_m = number("tx_m");
  pair.ty_m = number("ty_m");
  pair.tz_m = number("tz_m");
  pair.overlap_percent = number("overlap_percent");
  pair.rmse_m = number("rmse_m");
  return pair;
}

std::vector<PublishedPair> pairs(const std::string& name) {
  const CsvTable table = published(name);
  std::vector<PublishedPair> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    rows.push_back(pair_of(table, i));
    rows.back().fixed = table.text(i, "fixed");
    rows.back().moving = table.text(i, "moving");
  }
  return rows;
}

std::vector<PublishedAverage> averages(const std::string& name) {
  const CsvTable table = published(name);
  std::vector<PublishedAverage> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    rows.push_back({table.text(i, "block"), pair_of(table, i)});
  return rows;
}

}  // namespace

PublishedTables load_published_tables() {
  PublishedTables tables;
  const CsvTable sampling = published("table1_sampling_methods");
  for (std::size_t i = 0; i < sampling.rows.size(); ++i)
    tables.sampling.push_back({sampling.text(i, "minimization"), sampling.text(i, "fixed_method"),
                               sampling.text(i, "moving_method"),
                               *sampling.number(i, "fixed_points"),
                               *sampling.number(i, "moving_points"), *sampling.number(i, "time_s"),
                               *sampling.number(i, "rmse_m")});
  const CsvTable grids = published("table2_grid_sizes");
  for (std::size_t i = 0; i < grids.rows.size(); ++i)
    tables.grids.push_back({grids.text(i, "station"), *grids.number(i, "points_grid_0.01_m"),
                            *grids.number(i, "points_grid_0.025_m"),
                            *grids.number(i, "points_grid_0.05_m")});
  tables.bell_tower = pairs("table3_bell_tower_pairs");
  tables.lighthouse = pairs("table4_lighthouse_pairs");
  tables.tower_averages = averages("table3_averages");
  tables.lighthouse_averages = averages("table4_averages");
  return tables;
}

}  // namespace alea::experiments::markerless
