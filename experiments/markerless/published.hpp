#pragma once

#include <string>
#include <vector>

namespace alea::experiments::markerless {

/// One row of Tables 3 and 4 as printed, fixed and moving named.
struct PublishedPair {
  std::string fixed, moving;
  double omega_deg = 0, phi_deg = 0, kappa_deg = 0;
  double tx_m = 0, ty_m = 0, tz_m = 0;
  double overlap_percent = 0, rmse_m = 0;
};

/// A printed average of one block of a table.
struct PublishedAverage {
  std::string block;
  PublishedPair values;  ///< fixed and moving empty
};

struct PublishedSampling {
  std::string minimisation, fixed_method, moving_method;
  double fixed_points = 0, moving_points = 0, time_s = 0, rmse_m = 0;
};

struct PublishedGrid {
  std::string station;
  double points_010 = 0, points_025 = 0, points_050 = 0;  ///< at 0.01, 0.025, 0.05 m
};

/// Every number of the orientation study's tables.
struct PublishedTables {
  std::vector<PublishedSampling> sampling;            // Table 1
  std::vector<PublishedGrid> grids;                   // Table 2
  std::vector<PublishedPair> bell_tower, lighthouse;  // Tables 3 and 4
  std::vector<PublishedAverage> tower_averages, lighthouse_averages;
};

/// Reads experiments/markerless/published/*.csv. Throws Error(input).
PublishedTables load_published_tables();

}  // namespace alea::experiments::markerless
