#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/plane.hpp"

namespace alea {

/// Which algorithm says what points belong together; the README of this folder compares them.
enum class PlaneDetector {
  cells,             ///< adaptive voxels with moments: no normals, no neighbours, no random numbers
  efficient_ransac,  ///< CGAL's, after Schnabel, Wahl, Klein 2007
  region_growing,    ///< CGAL's, over k nearest neighbours
  ndt_ransac         ///< after Li et al. 2017, doi 10.3390/rs9050433
};

const char* to_string(PlaneDetector detector);
/// Throws Error(usage) for a name that is not a detector's.
PlaneDetector plane_detector_from_name(const std::string& name);

/// Lengths are in the unit of the cloud: a cloud in millimetres wants them in millimetres.
struct PlaneDetectionOptions {
  PlaneDetector detector = PlaneDetector::cells;
  double tolerance_m = 0.006;  ///< a member lies at most this far from its plane; about 4 sigma
  std::size_t min_points = 50;
  /// Length that says what is connected: the largest cell of `cells`, the cell of `ndt_ransac`, the
  /// cluster_epsilon of `efficient_ransac`; not used by `region_growing`. 0 = from tolerance and
  /// density.
  double cell_m = 0;
  std::uint64_t seed = 1;  ///< efficient_ransac and ndt_ransac
  /// Largest angle between a point's normal and its plane's (efficient_ransac, region_growing,
  /// ndt_ransac).
  double normal_angle_rad = 0.4510;
  double miss_probability =
      0.01;  ///< of overlooking the best candidate (efficient_ransac, ndt_ransac)
  std::size_t neighbours = 16;  ///< for point normals (efficient_ransac, region_growing)
};

/// Points that lie on one plane and are connected.
struct PlaneRegion {
  std::vector<std::uint32_t> indices;  ///< into the cloud, ascending
  /// Orthogonal least squares of those of these points that no other plane claims too (within the
  /// tolerance, about shared borders); the normal points towards `scanner_position` where the cloud
  /// has one, else its largest component is positive.
  Plane plane;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< of the same points
  double rmse_m = 0;                                     ///< along the normal
};

/// The planes of a cloud, largest first (ties by centroid). A point belongs to one region at most;
/// non-finite points to none. Up to the numbering of the points, the same bits for any order of the
/// points and any thread count; a shift of the cloud changes the answer by the rounding of the
/// coordinates. Throws Error(usage) for an option out of range.
std::vector<PlaneRegion> detect_planes(const Cloud& cloud,
                                       const PlaneDetectionOptions& options = {});

}  // namespace alea
