#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "alea/markerless/prepared_scan.hpp"

namespace alea {

struct WallCorrelationOptions {
  double cell_m = 0.4;    ///< of the images seen from above; widened for wide scans
  int image_cells = 128;  ///< a side, a power of two; 256 for wide scans
};

/// A horizontal shift of the moving scan at which walls lie on walls.
struct WallShift {
  Eigen::Vector2d shift_m;
  double score = 0;  ///< correlation as a share of the largest possible
};

/// The vertical surfaces of two upright scans, seen from above, correlated with regard to the way
/// they face. Images of one scan with itself show its symmetry.
class WallCorrelation {
 public:
  WallCorrelation(const PreparedScan& fixed, const PreparedScan& moving,
                  const WallCorrelationOptions& options);
  ~WallCorrelation();

  /// With the moving scan turned by `yaw_rad`: the best shifts at least three cells apart, best
  /// first, at most `count`.
  std::vector<WallShift> best(double yaw_rad, int count) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace alea
