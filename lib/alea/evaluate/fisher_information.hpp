#pragma once

#include <Eigen/Core>

#include "alea/evaluate/fisher_scene.hpp"

namespace alea {

/// What one station learns of one facet: the sum over its rays of w z z' with
/// z = (1, (x - q) . e1, (x - q) . e2), x the point of the ray on the facet, q the mean of the
/// corners, e1 and e2 the tangent_basis of the normal, w = 1 / normal_sd_m^2.
/// The sum is taken as an integral: a surface element dA at range rho receives
/// cos(incidence) dA / (rho^2 step^2 cos(elevation)) rays of a regular azimuth and elevation grid.
/// Zero where the facet does not face the station; points that `station.sees` denies do not count.
Eigen::Matrix3d facet_information(const FisherFacet& facet, const FisherStation& station,
                                  const NoiseModel& noise);

/// What one station learns of one sphere: the sum of w m m' with m = (n, 1), n the outward normal
/// where the ray meets the sphere. The residual is the distance from the surface, so that n carries
/// the centre (or the station's shift) and 1 the radius. Zero where the station is inside.
Eigen::Matrix4d sphere_information(const FisherSphere& sphere, const FisherStation& station,
                                   const NoiseModel& noise);

/// The point that the tilts of a facet turn about: the mean of its corners.
Eigen::Vector3d facet_centre(const FisherFacet& facet);

}  // namespace alea
