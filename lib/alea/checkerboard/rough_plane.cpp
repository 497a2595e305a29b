#include "alea/checkerboard/rough_plane.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

constexpr std::array<double, 5> slabs{0.003, 0.008, 0.02, 0.06, 0.15};  // of the side

/// Log-likelihood of points in a slab of this half thickness and the rest anywhere in the crop,
/// over that of all anywhere.
double slab_gain(std::size_t inside, std::size_t all, double half_thickness, double crop_radius) {
  const double n = static_cast<double>(all), k = static_cast<double>(inside);
  if (inside == 0) return 0;
  const double share = k / n, volume = half_thickness / crop_radius;
  double gain = k * std::log(share / volume);
  if (inside < all) gain += (n - k) * std::log((1 - share) / std::max(1 - volume, 1e-6));
  return gain;
}

struct Slab {
  Plane plane;
  double half_thickness = 0, gain = 0;
};

void improve(const Plane& plane, const std::vector<Eigen::Vector3d>& sample, double side_m,
             double radius, Slab& best) {
  std::array<std::size_t, slabs.size()> counts{};
  for (const Eigen::Vector3d& p : sample) {
    const double off = std::abs(plane.signed_distance(p)) / side_m;
    for (std::size_t k = 0; k < slabs.size(); ++k) counts[k] += off <= slabs[k];
  }
  for (std::size_t k = 0; k < slabs.size(); ++k) {
    const double gain = slab_gain(counts[k], sample.size(), slabs[k] * side_m, radius);
    if (counts[k] >= 8 && gain > best.gain) best = {plane, slabs[k] * side_m, gain};
  }
}

/// Principal components of the sample points within 1.5 half thicknesses.
Plane refitted(const Slab& slab, const std::vector<Eigen::Vector3d>& sample) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double n = 0;
  for (const Eigen::Vector3d& p : sample) {
    if (std::abs(slab.plane.signed_distance(p)) > 1.5 * slab.half_thickness) continue;
    sum += p;
    squares += p * p.transpose();
    ++n;
  }
  const Eigen::Vector3d mean = sum / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / n -
                                                              mean * mean.transpose());
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return {normal, normal.dot(mean)};
}

}  // namespace

std::optional<RoughPlane> find_rough_plane(const BoardPoints& points, double side_m) {
  if (points.size() < 8) return std::nullopt;
  constexpr std::size_t most = 600;
  std::vector<Eigen::Vector3d> sample;
  const double stride = std::max(1.0, static_cast<double>(points.size()) / most);
  double radius = 0;
  for (double at = 0; at < static_cast<double>(points.size()); at += stride) {
    sample.push_back(points.positions[static_cast<std::size_t>(at)]);
    radius = std::max(radius, sample.back().norm());
  }
  RandomStream stream({1, 50, 0, 0, Purpose::plane_detector});
  Slab best;
  for (int trial = 0; trial < 120; ++trial) {
    const Eigen::Vector3d& a = sample[stream.below(sample.size())];
    const Eigen::Vector3d& b = sample[stream.below(sample.size())];
    const Eigen::Vector3d& c = sample[stream.below(sample.size())];
    const Eigen::Vector3d across = (b - a).cross(c - a);
    if (across.norm() < 0.01 * side_m * side_m) continue;
    const Eigen::Vector3d normal = across.normalized();
    improve({normal, normal.dot(a)}, sample, side_m, radius, best);
  }
  if (best.gain <= 0) return std::nullopt;
  for (int round = 0; round < 4; ++round)
    improve(refitted(best, sample), sample, side_m, radius, best);
  RoughPlane rough{best.plane, best.half_thickness, {}};
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (std::abs(best.plane.signed_distance(points.positions[i])) <= 3 * best.half_thickness)
      rough.members.push_back(i);
  return rough;
}

}  // namespace alea
