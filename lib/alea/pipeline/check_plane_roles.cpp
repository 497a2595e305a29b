#include "alea/pipeline/check_plane_roles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"

namespace alea {
namespace {

constexpr double named_plane_reach_m = 1.0;

}  // namespace

std::vector<CheckPlaneRole> named_check_planes(std::span<const CommonPlane> planes,
                                               std::span<const Eigen::Vector3d> centroids_m) {
  std::vector<CheckPlaneRole> roles(planes.size(), CheckPlaneRole::calibration);
  for (const Eigen::Vector3d& centroid : centroids_m) {
    const auto distance_m = [&](const CommonPlane& plane) {
      return (plane.fit_master.centroid_m - centroid).norm() +
             10 * std::abs(plane.fit_master.plane.signed_distance(centroid));
    };
    const auto nearest = std::min_element(
        planes.begin(), planes.end(),
        [&](const auto& a, const auto& b) { return distance_m(a) < distance_m(b); });
    if (nearest == planes.end() || distance_m(*nearest) > named_plane_reach_m)
      throw input_error(fmt::format(
          "--check-planes: no plane that both scans see is near ({}, {}, {}) m; run once without "
          "it and take centroids from check_planes",
          centroid.x(), centroid.y(), centroid.z()));
    roles[static_cast<std::size_t>(nearest - planes.begin())] = CheckPlaneRole::check;
  }
  return roles;
}

std::vector<CommonPlane> planes_with_role(std::span<const CommonPlane> planes,
                                          std::span<const CheckPlaneRole> roles,
                                          CheckPlaneRole role) {
  std::vector<CommonPlane> chosen;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (roles[i] == role) chosen.push_back(planes[i]);
  return chosen;
}

}  // namespace alea
