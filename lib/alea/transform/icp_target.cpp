#include "alea/transform/icp_target.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/cloud/spatial_order.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/plane.hpp"

namespace alea {
namespace {

double intensity_of(const Cloud& cloud, std::uint32_t i) {
  if (cloud.has_intensity()) return cloud.intensity[i];
  const Colour& c = cloud.colours[i];
  return (static_cast<double>(c[0]) + c[1] + c[2]) / (3.0 * 65535.0);
}

/// Least squares gradient of the intensity over the neighbours of a point, in its tangent plane:
/// sum over neighbours p' of (C(p) + d . (f(p') - p) - C(p'))^2 with d . n = 0. Equation (10).
/// Where the neighbours span a line only, the part along it.
Eigen::Vector3d tangent_gradient(const IcpPoints& points, std::uint32_t at,
                                 const std::vector<Neighbour>& neighbours, double radius_m) {
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(points.normals[at]);
  Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  std::size_t used = 0;
  for (const Neighbour& neighbour : neighbours) {
    if (neighbour.index == at || neighbour.squared_distance_m2 > radius_m * radius_m) continue;
    const Eigen::Vector2d off =
        basis.transpose() * (points.positions[neighbour.index] - points.positions[at]);
    normal_matrix += off * off.transpose();
    right += off * (points.intensity[neighbour.index] - points.intensity[at]);
    ++used;
  }
  if (used < 3) return Eigen::Vector3d::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(normal_matrix);
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (int k = 0; k < 2; ++k) {
    if (solver.eigenvalues()[k] <= 1e-9 * solver.eigenvalues()[1]) continue;
    const Eigen::Vector2d direction = solver.eigenvectors().col(k);
    slope += direction * (direction.dot(right) / solver.eigenvalues()[k]);
  }
  return basis * slope;
}

/// The nearest points of a point, and all others that are as far as the last of them: on a raster
/// the last ring taken in part would tilt every gradient the same way, and the board drifts.
std::vector<Neighbour> whole_rings(const NeighbourIndex& index, const Eigen::Vector3d& point,
                                   std::size_t count) {
  constexpr double rounding = 1 + 1e-9;
  std::vector<Neighbour> found = index.nearest(point, count + 1);
  if (found.size() <= count) return found;
  const double last_m2 = found[count - 1].squared_distance_m2 * rounding;
  if (found[count].squared_distance_m2 <= last_m2) return index.within(point, std::sqrt(last_m2));
  found.pop_back();
  return found;
}

std::vector<Eigen::Vector3d> gradients_of(const IcpTarget::Data& target,
                                          const IcpOptions& options) {
  const double radius_m =
      options.gradient_radius_m > 0 ? options.gradient_radius_m : 2 * options.max_distance_m;
  std::vector<Eigen::Vector3d> gradients(target.points.positions.size());
  parallel_chunks(gradients.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto neighbours =
          whole_rings(*target.index, target.points.positions[i], options.gradient_neighbours);
      gradients[i] =
          tangent_gradient(target.points, static_cast<std::uint32_t>(i), neighbours, radius_m);
    }
  });
  return gradients;
}

}  // namespace

void require_valid(const IcpOptions& options) {
  const auto require = [](bool valid, const char* message) {
    if (!valid) throw usage_error(message);
  };
  require(options.max_distance_m > 0, "icp: max_distance_m must be positive");
  require(options.max_iterations >= 0, "icp: max_iterations must not be negative");
  require(options.rotation_tolerance_rad >= 0 && options.translation_tolerance_m >= 0 &&
              options.settled_change >= 0,
          "icp: tolerances must not be negative");
  require(options.trim_share >= 0 && options.trim_share < 1, "icp: trim_share must be in [0, 1)");
  require(options.normal_angle_rad > 0, "icp: normal_angle_rad must be positive");
  require(options.null_space_share >= 0 && options.null_space_share < 1,
          "icp: null_space_share must be in [0, 1)");
  require(options.lambda >= 0 && options.lambda <= 1, "icp: lambda must be in [0, 1]");
  require(options.gradient_neighbours >= 4, "icp: gradient_neighbours must be at least 4");
  require(options.gradient_radius_m >= 0, "icp: gradient_radius_m must not be negative");
}

IcpPoints icp_points(const Cloud& cloud, const char* what) {
  if (cloud.empty()) throw usage_error(fmt::format("icp: the {} has no points", what));
  const std::vector<std::uint32_t> order = spatial_order(cloud);
  IcpPoints points;
  Eigen::Vector3d low = cloud.positions[0], high = low;
  for (const Eigen::Vector3d& p : cloud.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  points.origin = (low + high) / 2;
  points.positions.resize(order.size());
  if (!cloud.normals.empty()) points.normals.resize(order.size());
  const bool has_colour = cloud.has_intensity() || !cloud.colours.empty();
  if (has_colour) points.intensity.resize(order.size());
  parallel_chunks(order.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      points.positions[i] = cloud.positions[order[i]] - points.origin;
      if (!points.normals.empty())
        points.normals[i] = cloud.normals[order[i]].cast<double>().normalized();
      if (has_colour) points.intensity[i] = intensity_of(cloud, order[i]);
    }
  });
  return points;
}

IcpTarget::IcpTarget(const Cloud& target, const IcpOptions& options) {
  require_valid(options);
  const bool wants_normals = options.objective != IcpObjective::point_to_point ||
                             options.normal_angle_rad < std::numbers::pi / 2;
  if (wants_normals && target.normals.empty() && !target.empty())
    throw usage_error("icp: the target has no normals; estimate them first");
  auto data = std::make_unique<Data>();
  data->points = icp_points(target, "target");
  data->index.emplace(data->points.positions);
  if (options.objective == IcpObjective::coloured) {
    if (data->points.intensity.empty())
      throw usage_error("icp: the coloured objective needs a target with intensities or colours");
    data->gradients = gradients_of(*data, options);
  }
  data_ = std::move(data);
}

IcpTarget::~IcpTarget() = default;
IcpTarget::IcpTarget(IcpTarget&&) noexcept = default;
IcpTarget& IcpTarget::operator=(IcpTarget&&) noexcept = default;

}  // namespace alea
