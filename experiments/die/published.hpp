#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/engine/verdict.hpp"

namespace alea::experiments::die {

/// One row of Table 1: a scan of a dataset. Inputs of the twins.
struct PublishedScan {
  std::string dataset;  ///< "A" to "D"
  int cloud = 1;        ///< 1 master, 2 slave
  std::string points;   ///< as printed
  double scanner_to_die_m = 0;
  std::vector<int> pips;  ///< the facets scanned
};

/// One row of Tables 2 to 5. Fields that the print merges with a neighbour are empty.
struct PublishedCheckPlane {
  std::string dataset;
  std::string plane;  ///< "A-1"
  bool vertical = true;
  std::optional<double> distance_station1_m, distance_die_m;
  std::string before_master_mm, before_slave_mm, uncalibrated_mm, calibrated_mm, spheres_mm;
};

/// One row of Table 6.
struct PublishedDie {
  std::string dataset;
  int cloud = 1;
  std::string angle_xy_deg, angle_xz_deg, angle_yz_deg;
  double nominal_edge_m = 0;
  std::string calibrated_edge_m;
};

/// Every number that the paper prints in its tables (Table 7 is pictures).
struct PublishedTables {
  std::vector<PublishedScan> scans;
  std::vector<PublishedCheckPlane> check_planes;
  std::vector<PublishedDie> dice;
};

/// Reads experiments/die/published/*.csv. Throws Error(input).
PublishedTables load_published_tables();

}  // namespace alea::experiments::die
