#pragma once

#include <Eigen/Core>

namespace alea {

/// A beam leaves off the reported ray by the pointing error (NoiseModel::angular_noise_rad). Near a
/// facet's border that error decides what the beam meets: rays that report a place just beyond a
/// silhouette count only when they were off towards the facet, rays just inside are lost when they
/// were off the other way, and beyond an edge the beam measures the neighbour. The ranges that are
/// left lean the plane. Rays as many standard deviations of the pointing as this away from every
/// border keep 2.3 % of that.
inline constexpr double border_pointing_sds = 2;

/// Standard deviation (m), along the unit vector `across`, of where a ray meets a plane:
/// `ray_m` leads from the scanner to that place, `normal` is the plane's, `pointing_rad` the
/// pointing's standard deviation in each of two directions across the ray.
double pointing_sd_m(const Eigen::Vector3d& ray_m, const Eigen::Vector3d& normal,
                     const Eigen::Vector3d& across, double pointing_rad);

}  // namespace alea
