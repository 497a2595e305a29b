#pragma once

#include <optional>
#include <vector>

#include "alea/cloud/neighbours.hpp"
#include "alea/transform/icp.hpp"

namespace alea {

/// One cloud as the solver holds it: in spatial order, about an origin of its own.
struct IcpPoints {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> positions;  ///< from the origin
  std::vector<Eigen::Vector3d> normals;    ///< unit, or empty
  std::vector<double> intensity;           ///< or the mean of the colours in [0, 1], or empty
};

struct IcpTarget::Data {
  IcpPoints points;
  std::optional<NeighbourIndex> index;
  /// Gradient of the intensity on the tangent plane at each point (1/m), Equation (10).
  std::vector<Eigen::Vector3d> gradients;
};

/// Copies what the objective needs. Throws Error(usage), naming `what`, for an empty cloud.
IcpPoints icp_points(const Cloud& cloud, const char* what);

/// Throws Error(usage) for the first option that is out of range.
void require_valid(const IcpOptions& options);

}  // namespace alea
