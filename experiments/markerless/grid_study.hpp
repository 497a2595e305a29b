#pragma once

#include <string>
#include <vector>

#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// Identity and near_truth: the paper's ICP from there; robust: the robust method on that grid,
/// from nothing.
enum class GridStart { identity, near_truth, robust };

/// One registration at one grid size.
struct GridTrial {
  double cell_m = 0;
  GridStart start = GridStart::identity;
  std::size_t points = 0;
  double rmse_m = 0, rmse_at_truth_m = 0;
  PoseError error;
};

struct GridStudyOptions {
  std::vector<double> cells_m{0.01, 0.025, 0.05, 0.1};  ///< the paper's grids
  std::vector<double> robust_cells_m{0.025, 0.05, 0.1};
  int draws = 5;  ///< starts near the truth, each 3 deg and 0.23 m away
  std::uint64_t seed = 1;
};

/// The paper's second aim: the grid against accuracy. ST1-ST2 both ways by the paper's ICP from
/// identity and from near the truth, and by the robust method, on every grid.
std::vector<GridTrial> run_grids(const TwinScans& scans, const GridStudyOptions& options,
                                 const ProgressCallback& progress = {});

/// Points, RMSE and true errors of each grid, and what RMSE and errors do as the grid grows.
ResultTable grid_table(const std::vector<GridTrial>& trials);

/// RMSE, rotation and translation error against the grid: FOLDER/NAME.png.
void draw_grids(const std::vector<GridTrial>& trials, const std::string& folder,
                const std::string& name);

}  // namespace alea::experiments::markerless
