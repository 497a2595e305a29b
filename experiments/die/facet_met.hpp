#pragma once

#include <Eigen/Core>
#include <array>

#include "alea/core/plane.hpp"

namespace alea::experiments::die {

/// The facet (0 to 2) whose plane the ray through `p` meets last, where it enters a convex body;
/// scan frame with the scanner at the origin, metres.
inline int facet_met(const Eigen::Vector3d& p, const std::array<Plane, 3>& planes) {
  int facet = 0;
  double farthest = 0;
  for (int k = 0; k < 3; ++k) {
    const double share = planes[k].offset_m / planes[k].normal.dot(p);
    if (share <= farthest) continue;
    facet = k;
    farthest = share;
  }
  return facet;
}

}  // namespace alea::experiments::die
