#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "alea/markerless/prepared_scan.hpp"

namespace alea {

/// The height differences at which the horizontal surfaces of two upright scans lie on each other,
/// floors on floors and ceilings on ceilings.
class HeightVote {
 public:
  /// `range_m`: the largest difference of the scanners' heights.
  HeightVote(const PreparedScan& fixed, const PreparedScan& moving, double range_m);

  /// For a yaw (rad) and a horizontal shift (m) of the moving scan: the best height and, where
  /// another one gets more than half of its votes, that one too. Zero where nothing is horizontal.
  std::vector<double> best(double yaw_rad, const Eigen::Vector2d& shift_m) const;

 private:
  struct Level {
    Eigen::Vector2d place_m;
    double height_m;
    bool up;
  };
  static std::vector<Level> levels_of(const PreparedScan& scan);
  static std::array<int, 3> cell_of(const Eigen::Vector2d& place_m, bool up);

  double range_m_;
  std::map<std::array<int, 3>, std::vector<double>> fixed_heights_;
  std::vector<Level> moving_;
};

}  // namespace alea
