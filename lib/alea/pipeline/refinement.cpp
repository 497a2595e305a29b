#include "alea/pipeline/refinement.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "alea/core/error.hpp"
#include "alea/pipeline/plane_solution.hpp"
#include "alea/transform/icp.hpp"

namespace alea {
namespace {

constexpr double pair_distance_m = 0.05;
constexpr double pair_angle_rad = 0.2;
constexpr std::size_t most_points = 40000;  // of either scan: an ICP step is linear in them

/// The points of the planes with the planes' normals, evenly thinned.
Cloud points_with_normals(const Cloud& cloud, std::span<const CommonPlane> planes, bool master) {
  std::size_t total = 0;
  for (const CommonPlane& plane : planes)
    total += (master ? plane.indices_master : plane.indices_slave).size();
  const std::size_t stride = total / most_points + 1;
  Cloud out;
  for (const CommonPlane& plane : planes) {
    const auto& indices = master ? plane.indices_master : plane.indices_slave;
    const PlaneFit& fit = master ? plane.fit_master : plane.fit_slave;
    for (std::size_t i = 0; i < indices.size(); i += stride) {
      out.positions.push_back(cloud.positions[indices[i]]);
      out.normals.push_back(fit.plane.normal.cast<float>());
    }
  }
  return out;
}

Result<RefinedTransform> refine_by_icp(const Cloud& master, const Cloud& slave,
                                       std::span<const CommonPlane> planes,
                                       const RigidTransform& start) {
  IcpOptions options;
  options.objective = IcpObjective::point_to_plane;
  options.max_distance_m = pair_distance_m;
  options.normal_angle_rad = pair_angle_rad;
  const IcpResult found = icp(points_with_normals(master, planes, true),
                              points_with_normals(slave, planes, false), start, options);
  if (found.stop == IcpStop::too_few_pairs || found.determined < 6)
    return Refusal{RefusalCode::unobservable,
                   fmt::format("ICP on {} planes determines {} of six parameters; floor and two "
                               "walls that are not parallel are needed",
                               planes.size(), found.determined)};
  if (!found.converged())
    return Refusal{RefusalCode::no_convergence,
                   fmt::format("ICP did not settle in {} iterations", found.iterations)};
  RefinedTransform out;
  out.master_from_slave = found.target_from_source;
  out.covariance = {found.information.inverse(), found.information_about_m};
  out.report.pairs = found.pairs;
  out.report.iterations = found.iterations;
  return out;
}

Result<RefinedTransform> refine_by_planes(std::span<const CommonPlane> planes,
                                          const RigidTransform& start) {
  const Result<PlaneSolution> solution = solve_planes(planes, start);
  if (!solution) return solution.refusal();
  RefinedTransform out;
  out.master_from_slave = solution->master_from_slave;
  out.covariance = solution->covariance;
  out.report.pairs = planes.size();
  out.report.iterations = solution->iterations;
  return out;
}

}  // namespace

const char* to_string(Refinement refinement) {
  switch (refinement) {
    case Refinement::none:
      return "none";
    case Refinement::planes:
      return "planes";
    case Refinement::icp:
      return "icp";
  }
  return "unknown";
}

Result<RefinedTransform> refine_registration(Refinement refinement, const Cloud& master,
                                             const Cloud& slave,
                                             std::span<const CommonPlane> planes,
                                             const RigidTransform& start,
                                             const Eigen::Vector3d& about_m) {
  if (refinement == Refinement::none)
    throw usage_error("refine_registration: say by what, planes or icp");
  // ICP has no answer of its own to planes that do not span: their count and normals decide first.
  Result<RefinedTransform> refined = refine_by_planes(planes, start);
  if (refined && refinement == Refinement::icp)
    refined = refine_by_icp(master, slave, planes, start);
  if (!refined) return refined;
  const RigidTransform change = refined->master_from_slave * start.inverse();
  refined->report.method = to_string(refinement);
  refined->report.planes = planes.size();
  refined->report.rotation_rad = rotation_angle_rad(change.rotation);
  refined->report.translation_m = change * about_m - about_m;
  refined->report.about_m = about_m;
  return refined;
}

}  // namespace alea
