#pragma once

#include <string>
#include <vector>

#include "experiments/checkerboard/success.hpp"
#include "experiments/checkerboard/synthetic_trial.hpp"

namespace alea::experiments::checkerboard {

/// One point of a figure: all pairs of one shift.
struct CurvePoint {
  int shift_percent = 0;
  Share strict, symmetric;
  double rmse_mean = 0, rmse_sd = 0, rmse_median = 0;  ///< shares of the side
};

/// One line of a figure.
struct Curve {
  std::string figure;  ///< "6", "7", "8"
  Method method = Method::coloured;
  SyntheticCase synthetic;  ///< its shift has no meaning
  int rotation_deg = 0;
  std::vector<CurvePoint> points;  ///< shifts 0, 10, ... 150 %

  std::string name() const;
  const CurvePoint& at(int shift_percent) const { return points[shift_percent / 10]; }
};

Curve run_curve(const std::string& figure, Method method, const SyntheticCase& synthetic,
                int rotation_deg, std::uint64_t seed, std::uint64_t pairs);

std::string curves_csv(const std::vector<Curve>& curves);

/// Success with Wilson intervals above, mean RMSE with standard deviations below; PNG. More than
/// eight lines get a column for each method. `numbers` writes the standard deviation beside each
/// point, as Figure 8 does.
void draw_curves(const std::string& path, const std::string& title,
                 const std::vector<Curve>& curves, bool numbers);

}  // namespace alea::experiments::checkerboard
