#pragma once

#include <Eigen/Core>
#include <vector>

#include "alea/markerless/prepared_scan.hpp"

namespace alea {

/// A vertical axis about which what a scan shows lies on itself.
struct SymmetryAxis {
  Eigen::Vector2d place_m;  ///< upright frame
  double score = 0;         ///< sum of the correlations that point to it
};

/// The most likely axes of a tower, a column, a round or polygonal building: the scan's walls are
/// correlated with themselves turned by 45, 60, 90 and 120 deg either way; each shift found there
/// has a fixed point, and places where several lie together are axes. Best first, at most `count`.
std::vector<SymmetryAxis> symmetry_axes(const PreparedScan& scan, std::size_t count);

}  // namespace alea
