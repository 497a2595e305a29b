#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/facet/plane_fit.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

/// A plane that both scans see, cut down to the area that both cover. Slave quantities are in the
/// slave's frame.
struct CommonPlane {
  int id = 0;  ///< from 1, in the order of decreasing common point count
  std::vector<std::uint32_t> indices_master;  ///< into the master cloud, ascending
  std::vector<std::uint32_t> indices_slave;   ///< into the slave cloud, ascending
  PlaneFit fit_master;  ///< orthogonal fits, covariance scaled by their own variance factor
  PlaneFit fit_slave;
};

struct CommonPlaneOptions {
  double max_angle_rad = 0.087;  ///< between the normals under the given transform
  double max_offset_m = 0.15;    ///< between the planes, at the common area
  double raster_m = 0.1;         ///< cell of the raster in which the common area is found
  std::size_t min_points = 100;  ///< in the common area, in each scan
};

/// Finds the planes common to both scans under an approximate transform. Each region is paired at
/// most once, with the region that shares the most area with it. `exclude_*` are point indices
/// (ascending) that may not take part, e.g. a target's own facets.
std::vector<CommonPlane> find_common_planes(const Cloud& master,
                                            std::span<const PlaneRegion> master_regions,
                                            const Cloud& slave,
                                            std::span<const PlaneRegion> slave_regions,
                                            const RigidTransform& master_from_slave,
                                            const CommonPlaneOptions& options = {});

enum class CheckPlaneRole { check, calibration };

/// How well two scans agree at one plane. All lengths in metres, in the master frame.
struct CheckPlane {
  int id = 0;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< of the master's points
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();     ///< of the master's plane
  std::size_t points_master = 0;
  std::size_t points_slave = 0;
  double alone_master_m = 0;     ///< RMSE of an orthogonal fit to the master's points
  double alone_slave_m = 0;      ///< RMSE of an orthogonal fit to the slave's points
  double union_m = 0;            ///< RMSE of an orthogonal fit to both
  double slave_to_master_m = 0;  ///< RMSE of the transformed slave points about the master's plane
  double offset_m =
      0;  ///< transformed slave plane minus master plane along the normal, at the master's centroid
  double tilt_rad = 0;  ///< angle between the two planes
  CheckPlaneRole role = CheckPlaneRole::check;
};

/// Evaluates one pair under a transform.
CheckPlane evaluate_check_plane(const Cloud& master, const Cloud& slave, const CommonPlane& pair,
                                const RigidTransform& master_from_slave);

/// Share of `a`'s points that have a point of `b` within `distance_m`, under b_from_a. In [0, 1].
double overlap_share(const Cloud& a, const Cloud& b, const RigidTransform& b_from_a,
                     double distance_m);

}  // namespace alea
