#include "experiments/die/published.hpp"

#include <sstream>

#include "experiments/engine/build_info.hpp"
#include "experiments/engine/csv_table.hpp"

namespace alea::experiments::die {
namespace {

CsvTable published(const std::string& name) {
  return read_csv(data_dir() + "/experiments/die/published/" + name + ".csv");
}

std::vector<int> parse_pips(const std::string& text) {
  std::istringstream in(text);
  std::vector<int> pips;
  for (int value; in >> value;) pips.push_back(value);
  return pips;
}

}  // namespace

PublishedTables load_published_tables() {
  PublishedTables tables;
  const CsvTable scans = published("table1_datasets");
  for (std::size_t i = 0; i < scans.rows.size(); ++i)
    tables.scans.push_back({scans.text(i, "dataset"), static_cast<int>(*scans.number(i, "cloud")),
                            scans.text(i, "points"), *scans.number(i, "scanner_to_die_m"),
                            parse_pips(scans.text(i, "pips"))});
  const CsvTable planes = published("table2_to_5_check_planes");
  for (std::size_t i = 0; i < planes.rows.size(); ++i)
    tables.check_planes.push_back(
        {planes.text(i, "dataset"), planes.text(i, "plane"),
         planes.text(i, "orientation") == "vertical", planes.number(i, "distance_station1_m"),
         planes.number(i, "distance_die_m"), planes.text(i, "before_master_mm"),
         planes.text(i, "before_slave_mm"), planes.text(i, "uncalibrated_mm"),
         planes.text(i, "calibrated_mm"), planes.text(i, "spheres_mm")});
  const CsvTable dice = published("table6_angles_and_sizes");
  for (std::size_t i = 0; i < dice.rows.size(); ++i)
    tables.dice.push_back({dice.text(i, "dataset"), static_cast<int>(*dice.number(i, "cloud")),
                           dice.text(i, "angle_xy_deg"), dice.text(i, "angle_xz_deg"),
                           dice.text(i, "angle_yz_deg"), *dice.number(i, "nominal_edge_m"),
                           dice.text(i, "calibrated_edge_m")});
  return tables;
}

}  // namespace alea::experiments::die
