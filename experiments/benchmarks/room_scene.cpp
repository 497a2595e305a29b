#include "experiments/benchmarks/room_scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "alea/facet/plane_fit.hpp"
#include "alea/plane/region_fit.hpp"

namespace alea::benchmarks {
namespace {

// Pieces of the walls about the door and the niche, each with the first piece of its wall.
const std::map<int, int> first_piece{{5, 4}, {6, 4}, {11, 10}, {12, 10}};

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::asin(std::min(1.0, a.cross(b).norm())) * 180 / std::numbers::pi;
}

/// Standard deviation (deg) of the angle that a plane's points determine with only the scanner's
/// noise: the fit along the ray to exactly the true points.
double own_sd_deg(const Cloud& cloud, const std::vector<std::uint32_t>& members) {
  std::vector<Eigen::Vector3d> points;
  for (const std::uint32_t i : members) points.push_back(cloud.positions[i]);
  PlaneFitOptions options;
  options.scanner_position = cloud.scanner_position;
  options.noise = NoiseModel{.range_noise_m = testing::ScanOptions{}.range_noise_m,
                             .grazing_m = 0,
                             .surface_m = 0,
                             .angular_noise_rad = 0};
  const Eigen::Matrix3d covariance = fit_plane(points, options).covariance;
  return std::sqrt(covariance(0, 0) + covariance(1, 1)) * 180 / std::numbers::pi;
}

struct Match {
  double overlap = 0;
  std::size_t set = 0;
};

}  // namespace

Room make_room(std::size_t points, std::uint64_t seed) {
  testing::ScanOptions options;
  options.seed = seed;
  options.scanner = {3.5, 2.5, 1.5};
  options.step_rad =
      std::sqrt(2 * std::numbers::pi * std::numbers::pi / static_cast<double>(points));
  Room out{{}, testing::furnished_room()};
  out.scan = testing::scan_rectangles(out.planes, options);
  for (int& r : out.scan.rectangle)
    if (const auto it = first_piece.find(r); it != first_piece.end()) r = it->second;
  return out;
}

const Room& room(std::size_t points) {
  static std::map<std::size_t, Room> rooms;
  auto it = rooms.find(points);
  if (it == rooms.end()) it = rooms.emplace(points, make_room(points, 1)).first;
  return it->second;
}

Recovery recovery(const Room& room, const std::vector<std::vector<std::uint32_t>>& sets,
                  std::size_t least, const std::vector<Eigen::Vector3d>& normals) {
  std::vector<std::vector<std::uint32_t>> members(room.planes.size());
  for (std::uint32_t i = 0; i < room.scan.rectangle.size(); ++i)
    members[static_cast<std::size_t>(room.scan.rectangle[i])].push_back(i);
  std::vector<Match> best(room.planes.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    std::vector<std::size_t> common(room.planes.size(), 0);
    for (const std::uint32_t i : sets[s])
      ++common[static_cast<std::size_t>(room.scan.rectangle[i])];
    for (std::size_t p = 0; p < common.size(); ++p) {
      const double either = static_cast<double>(members[p].size() + sets[s].size() - common[p]);
      const double overlap = static_cast<double>(common[p]) / std::max(1.0, either);
      if (overlap > best[p].overlap) best[p] = {overlap, s};
    }
  }
  Recovery out;
  for (std::size_t p = 0; p < members.size(); ++p) {
    if (members[p].size() < least) continue;
    ++out.planes;
    if (best[p].overlap <= 0.5) continue;
    ++out.found;
    if (members[p].size() < 1000) continue;
    const testing::Rectangle& r = room.planes[p];
    const Eigen::Vector3d truth = r.side_a.cross(r.side_b).normalized();
    const std::size_t set = best[p].set;
    const Eigen::Vector3d fit =
        normals.empty() ? fit_region(room.scan.cloud, sets[set]).plane.normal : normals[set];
    const Eigen::Vector3d ideal = fit_region(room.scan.cloud, members[p]).plane.normal;
    const double error = angle_deg(fit, truth);
    out.errors.push_back({p, members[p].size(), error, angle_deg(ideal, truth),
                          own_sd_deg(room.scan.cloud, members[p])});
    out.worst_deg = std::max(out.worst_deg, error);
    out.worst_ideal_deg = std::max(out.worst_ideal_deg, angle_deg(ideal, truth));
    if (angle_deg(ideal, truth) <= 0.02)
      out.worst_determined_deg = std::max(out.worst_determined_deg, error);
  }
  return out;
}

}  // namespace alea::benchmarks
