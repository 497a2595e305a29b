#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/report/picture.hpp"

namespace alea {

/// Where the two registered scans are cut, master frame.
struct OverlayOptions {
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();  ///< both cuts pass through it
  double close_radius_m = 1;                          ///< half width of the close views
  double half_thickness_m = 0.05;                     ///< of the cuts
  std::string master_name = "master";
  std::string slave_name = "slave";
};

/// Both scans in the master's frame, cut level and upright through a point: the whole scene and
/// close by. What does not fit together shows as a double line.
Picture overlay_picture(const Cloud& master, const Cloud& slave,
                        const RigidTransform& master_from_slave, const OverlayOptions& options);

/// One pose of the slave to look at, with its name, e.g. "ST1 - ST2, estimate".
struct NamedPose {
  std::string name;
  RigidTransform master_from_slave;
};

/// The close views of two poses side by side, the level cut above the upright one.
Picture overlay_comparison(const Cloud& master, const Cloud& slave,
                           const std::array<NamedPose, 2>& poses, const OverlayOptions& options);

}  // namespace alea
