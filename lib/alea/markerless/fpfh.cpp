#include "alea/markerless/fpfh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

using std::numbers::pi;
constexpr int angle_bins = 11;

int bin_of(double value, double low, double high) {
  return std::clamp(static_cast<int>(angle_bins * (value - low) / (high - low)), 0, angle_bins - 1);
}

/// The angles alpha, phi, theta of a pair in its Darboux frame (their Equation 1), binned; the
/// frame stands on the point whose normal lies nearer to the line between them.
void add_pair(Eigen::Vector3d p, Eigen::Vector3d n, Eigen::Vector3d q, Eigen::Vector3d m,
              float weight, Fpfh& histogram) {
  Eigen::Vector3d d = q - p;
  const double length = d.norm();
  if (!(length > 0)) return;
  d /= length;
  if (std::abs(n.dot(d)) < std::abs(m.dot(d))) {
    std::swap(n, m);
    d = -d;
  }
  Eigen::Vector3d v = d.cross(n);
  const double across = v.norm();
  if (!(across > 1e-9)) return;
  v /= across;
  const Eigen::Vector3d w = n.cross(v);
  const double alpha = v.dot(m), phi = n.dot(d), theta = std::atan2(w.dot(m), n.dot(m));
  histogram[static_cast<std::size_t>(bin_of(theta, -pi, pi))] += weight;
  histogram[static_cast<std::size_t>(angle_bins + bin_of(alpha, -1, 1))] += weight;
  histogram[static_cast<std::size_t>(2 * angle_bins + bin_of(phi, -1, 1))] += weight;
}

void scale_to_100(Fpfh& histogram) {
  for (int part = 0; part < 3; ++part) {
    const auto begin = histogram.begin() + part * angle_bins, end = begin + angle_bins;
    float sum = 0;
    for (auto it = begin; it != end; ++it) sum += *it;
    if (sum > 0)
      for (auto it = begin; it != end; ++it) *it *= 100 / sum;
  }
}

}  // namespace

std::vector<Fpfh> fpfh(const Cloud& cloud, const NeighbourIndex& index, double radius_m,
                       FpfhWeights weights) {
  if (cloud.normals.size() != cloud.size())
    throw usage_error("fpfh: the cloud has no normals; estimate them first");
  const bool is_square = weights == FpfhWeights::inverse_square;
  std::vector<std::vector<Neighbour>> near(cloud.size());
  std::vector<Fpfh> simple(cloud.size(), Fpfh{}), features(cloud.size(), Fpfh{});
  parallel_chunks(cloud.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      near[i] = index.within(cloud.positions[i], radius_m);
      for (const Neighbour& other : near[i])
        if (other.index != i)
          add_pair(cloud.positions[i], cloud.normals[i].cast<double>(),
                   cloud.positions[other.index], cloud.normals[other.index].cast<double>(), 1,
                   simple[i]);
      scale_to_100(simple[i]);
    }
  });
  parallel_chunks(cloud.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {  // their Equation 2
      if (!is_square) features[i] = simple[i];
      const auto count = static_cast<double>(std::max<std::size_t>(near[i].size(), 2) - 1);
      for (const Neighbour& other : near[i]) {
        if (other.squared_distance_m2 == 0) continue;
        const auto weight = static_cast<float>(
            is_square ? 1 / other.squared_distance_m2
                      : 1 / (count * std::sqrt(other.squared_distance_m2) / radius_m));
        for (std::size_t k = 0; k < features[i].size(); ++k)
          features[i][k] += weight * simple[other.index][k];
      }
      scale_to_100(features[i]);
    }
  });
  return features;
}

}  // namespace alea
