#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

/// The finite points of a cloud in an order of their own, for algorithms whose answer depends on
/// the order, on the unit and on where the origin lies.
struct CanonicalPoints {
  /// From the least coordinates, in the unit in which the tolerance is 6: millimetres by default.
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::uint32_t> index;  ///< of each in the cloud
  double per_unit = 1;               ///< lengths of the cloud times this are lengths here
};

/// Sorted by cell of 64 tolerances, then by coordinates; of equal points one is kept, because
/// CGAL's octree never ends dividing a heap of them.
CanonicalPoints canonical_points(const Cloud& cloud, double tolerance_m);

/// Length at which the cloud hangs together, in its own unit: the option where given, else the cell
/// (`least_tolerances` tolerances, or doubled) that holds 12 points on average.
double connection_length_m(const Cloud& cloud, const PlaneDetectionOptions& options,
                           double least_tolerances);

/// Normals of points by principal components of their nearest neighbours (CGAL), unit, sign
/// arbitrary.
std::vector<Eigen::Vector3d> point_normals(const std::vector<Eigen::Vector3d>& positions,
                                           std::size_t neighbours);

}  // namespace alea
