#pragma once

#include <Eigen/Cholesky>

#include "alea/core/angle.hpp"
#include "alea/core/seed.hpp"
#include "experiments/die/skewed_die.hpp"

namespace alea {

/// A die that is no cube, seen without noise by two stations this far apart about it.
inline experiments::die::SkewedDie skewed(double separation_deg, std::uint64_t trial,
                                          double tilt_deg = 1) {
  experiments::die::SkewedDieOptions options;
  options.tilt_sd_rad = tilt_deg * deg;
  options.size_sd_share = 0.05;
  options.separation_rad = separation_deg * deg;
  return experiments::die::draw_skewed_die(options, 5, trial);
}

/// Covariance of a plausible fit: correlated tilts, an offset ten times better known than they are.
inline Eigen::Matrix3d plane_covariance(double scale) {
  Eigen::Matrix3d c;
  c << 4, 1, 0.02, 1, 1, 0.01, 0.02, 0.01, 0.01;
  return scale * 1e-10 * c;
}

/// Upper facets are fitted worse than the first.
inline void set_covariances(ObservedDie& die) {
  for (int k = 0; k < 3; ++k) die.facets[k].fit.covariance = plane_covariance(1 + 3 * k);
}

/// The observation with such covariances and a random error drawn from each.
inline ObservedDie noisy(const ObservedDie& die, RandomStream& stream) {
  ObservedDie out = die;
  set_covariances(out);
  for (ObservedFacet& facet : out.facets) {
    PlaneFit& fit = facet.fit;
    const Eigen::Vector3d normal(stream.normal(), stream.normal(), stream.normal());
    const Eigen::Vector3d abc = fit.covariance.llt().matrixL() * normal;
    fit.plane.normal = (fit.plane.normal + fit.tangent * abc.head<2>()).normalized();
    fit.centroid_m += abc(2) * fit.plane.normal;
    fit.plane.offset_m = fit.plane.normal.dot(fit.centroid_m);
    // The covariance refers to the tangent vectors before the turn; the difference is second order.
    fit.tangent = tangent_basis(fit.plane.normal);
  }
  return out;
}

}  // namespace alea
