#pragma once

#include <span>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/sphere/sphere_registration.hpp"

namespace alea {

struct SphereMatchOptions {
  /// Two distances agree within this many standard deviations of their difference ...
  double tolerance_sd = 5;
  /// ... plus what the covariances do not know (range offsets, spheres that are not round).
  double tolerance_m = 0.002;
  /// Log-likelihood by which the best of several equally large sets must lead.
  double least_margin = 10;
  std::size_t most_targets = 24;  ///< of each list, the first ones; the search grows fast
};

/// The spheres that both scans see, from the mutual distances of their centres alone: the largest
/// set of pairs in which every distance agrees, registered. Spheres that only one scan has, and
/// false ones, stay out of it.
/// Refuses as no_match where no three distances agree, the centres then do not fit (a mirrored
/// arrangement), or several sets of that size fit about as well (equal distances: a regular
/// polygon); as too_few_points with fewer than three spheres in a scan; as collinear.
Result<SphereRegistration> match_and_register(std::span<const SphereFit> master,
                                              std::span<const SphereFit> slave,
                                              const SphereMatchOptions& options = {});

}  // namespace alea
