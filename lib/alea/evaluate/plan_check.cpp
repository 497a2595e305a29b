#include "alea/evaluate/plan_check.hpp"

#include <cmath>

namespace alea {
namespace {

double mean_variance_m2(double scatter_m, std::size_t points) {
  return points > 0 ? scatter_m * scatter_m / static_cast<double>(points) : 0;
}

}  // namespace

std::vector<PlanCheck> check_plan(const TransformCovariance& predicted,
                                  const std::vector<CheckPlane>& planes) {
  std::vector<PlanCheck> checks;
  for (const CheckPlane& plane : planes) {
    if (plane.role != CheckPlaneRole::check) continue;
    const Eigen::Matrix3d at_plane =
        moved_to(predicted, plane.centroid_m).covariance.bottomRightCorner<3, 3>();
    const double variance = plane.normal.dot(at_plane * plane.normal) +
                            mean_variance_m2(plane.alone_master_m, plane.points_master) +
                            mean_variance_m2(plane.alone_slave_m, plane.points_slave);
    checks.push_back({plane.id, plane.centroid_m, plane.offset_m, std::sqrt(variance)});
  }
  return checks;
}

}  // namespace alea
