#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/result.hpp"
#include "alea/sphere/sphere_fit.hpp"

namespace alea {

struct SphereFinderOptions {
  /// How the spheres that were found are fitted; its radius is the one that is looked for.
  SphereFitOptions fit;
  /// In the frame of the points; empty: the cloud's own, else the frame's origin.
  std::optional<Eigen::Vector3d> scanner_position;
  double min_coverage =
      0.5;                   ///< share of the visible disc (24 parts) that has points on the sphere
  double min_purity = 0.75;  ///< share of the points before and in the sphere that lie on it
  double radius_tolerance = 0.04;  ///< of a fit with free radius, as a share; or 5 sd
};

struct SphereTarget {
  SphereFit fit;
  std::vector<std::uint32_t> indices;  ///< points on the sphere, ascending
};

/// Spheres of the given radius in a cloud of anything: votes of cells for centres, then for each
/// candidate a fit, and the checks that its points cover the visible disc, that hardly any point
/// lies before or in it, and that a free radius agrees. Sorted by the number of points, most first.
/// The same bits for any order of the points and any number of threads.
/// Refuses as no_target where there is none.
Result<std::vector<SphereTarget>> find_spheres(const Cloud& cloud,
                                               const SphereFinderOptions& options);

}  // namespace alea
