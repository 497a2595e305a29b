#include "alea/plane/region_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

__extension__ using Wide = __int128;

// Coordinates in whole steps of a power of two from a corner of the points' own box.
struct Steps {
  Eigen::Vector3d corner;
  double per_step;
};

Steps steps_of(const Cloud& cloud, const std::vector<std::uint32_t>& indices) {
  Eigen::Vector3d low = cloud.positions[indices.front()];
  Eigen::Vector3d high = low;
  for (const std::uint32_t i : indices) {
    low = low.cwiseMin(cloud.positions[i]);
    high = high.cwiseMax(cloud.positions[i]);
  }
  int exponent = 0;
  std::frexp(std::max((high - low).maxCoeff(), 1e-300), &exponent);
  return {low + (high - low) / 2, std::ldexp(1.0, 44 - exponent)};  // |coordinate| < 2^43 steps
}

struct WideSums {
  std::array<Wide, 3> first{};
  std::array<Wide, 6> second{};  // xx, xy, xz, yy, yz, zz
};

WideSums sums_of(const Cloud& cloud, const std::vector<std::uint32_t>& indices,
                 const Steps& steps) {
  WideSums s;
  for (const std::uint32_t i : indices) {
    const Eigen::Vector3d scaled = (cloud.positions[i] - steps.corner) * steps.per_step;
    const Wide x = static_cast<std::int64_t>(scaled.x());
    const Wide y = static_cast<std::int64_t>(scaled.y());
    const Wide z = static_cast<std::int64_t>(scaled.z());
    s.first[0] += x;
    s.first[1] += y;
    s.first[2] += z;
    s.second[0] += x * x;
    s.second[1] += x * y;
    s.second[2] += x * z;
    s.second[3] += y * y;
    s.second[4] += y * z;
    s.second[5] += z * z;
  }
  return s;
}

// Scatter about the mean, in steps squared: the means' whole part is taken off exactly first.
Eigen::Matrix3d scatter_of(const WideSums& s, Wide count) {
  const std::array<Wide, 3> mean{s.first[0] / count, s.first[1] / count, s.first[2] / count};
  const auto about_mean = [&](int k, int a, int b) {
    const Wide value =
        s.second[k] - mean[a] * s.first[b] - mean[b] * s.first[a] + count * mean[a] * mean[b];
    return static_cast<double>(value);
  };
  Eigen::Matrix3d out;
  out << about_mean(0, 0, 0), about_mean(1, 0, 1), about_mean(2, 0, 2), about_mean(1, 0, 1),
      about_mean(3, 1, 1), about_mean(4, 1, 2), about_mean(2, 0, 2), about_mean(4, 1, 2),
      about_mean(5, 2, 2);
  return out;
}

// Towards the scanner; where nobody said where it stood, the largest component is positive.
Plane oriented(const Plane& plane, const Cloud& cloud) {
  if (cloud.scanner_position)
    return plane.signed_distance(*cloud.scanner_position) < 0 ? plane.flipped() : plane;
  Eigen::Index largest = 0;
  plane.normal.cwiseAbs().maxCoeff(&largest);
  return plane.normal[largest] < 0 ? plane.flipped() : plane;
}

bool comes_first(const PlaneRegion& a, const PlaneRegion& b) {
  if (a.indices.size() != b.indices.size()) return a.indices.size() > b.indices.size();
  return std::lexicographical_compare(a.centroid_m.begin(), a.centroid_m.end(),
                                      b.centroid_m.begin(), b.centroid_m.end());
}

}  // namespace

PlaneRegion fit_region(const Cloud& cloud, std::vector<std::uint32_t> indices) {
  const Steps steps = steps_of(cloud, indices);
  const WideSums sums = sums_of(cloud, indices, steps);
  const auto count = static_cast<double>(indices.size());
  const Eigen::Matrix3d scatter = scatter_of(sums, static_cast<Wide>(indices.size()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  PlaneRegion region;
  region.indices = std::move(indices);
  const Eigen::Vector3d mean(static_cast<double>(sums.first[0]), static_cast<double>(sums.first[1]),
                             static_cast<double>(sums.first[2]));
  const Eigen::Vector3d from_corner = mean / count / steps.per_step;
  region.centroid_m = steps.corner + from_corner;
  region.plane.normal = eigen.eigenvectors().col(0).normalized();
  region.plane.offset_m = region.plane.normal.dot(region.centroid_m);
  region.plane = oriented(region.plane, cloud);
  region.rmse_m = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]) / count) / steps.per_step;
  return region;
}

std::vector<PlaneRegion> regions_from_labels(const Cloud& cloud,
                                             const std::vector<std::int32_t>& plane_of_point,
                                             std::size_t planes, std::size_t min_points) {
  std::vector<std::size_t> counts(planes, 0);
  for (const std::int32_t p : plane_of_point)
    if (p >= 0) ++counts[static_cast<std::size_t>(p)];
  std::vector<std::vector<std::uint32_t>> members(planes);
  const std::size_t least = std::max<std::size_t>(3, min_points);
  for (std::size_t p = 0; p < planes; ++p)
    if (counts[p] >= least) members[p].reserve(counts[p]);
  for (std::size_t i = 0; i < plane_of_point.size(); ++i) {
    const std::int32_t p = plane_of_point[i];
    if (p >= 0 && counts[static_cast<std::size_t>(p)] >= least)
      members[static_cast<std::size_t>(p)].push_back(static_cast<std::uint32_t>(i));
  }
  std::erase_if(members, [](const auto& m) { return m.empty(); });
  std::vector<PlaneRegion> regions(members.size());
  parallel_chunks(members.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) regions[p] = fit_region(cloud, std::move(members[p]));
  });
  std::sort(regions.begin(), regions.end(), comes_first);
  return regions;
}

}  // namespace alea
