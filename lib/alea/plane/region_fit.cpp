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
  std::int64_t count = 0;
  std::array<Wide, 3> first{};
  std::array<Wide, 6> second{};  // xx, xy, xz, yy, yz, zz

  void add(std::int64_t x, std::int64_t y, std::int64_t z) {
    const Wide wide_x = x, wide_y = y, wide_z = z;
    ++count;
    first[0] += x;
    first[1] += y;
    first[2] += z;
    second[0] += wide_x * x;
    second[1] += wide_x * y;
    second[2] += wide_x * z;
    second[3] += wide_y * y;
    second[4] += wide_y * z;
    second[5] += wide_z * z;
  }
  void add(const WideSums& other) {
    count += other.count;
    for (std::size_t k = 0; k < 3; ++k) first[k] += other.first[k];
    for (std::size_t k = 0; k < 6; ++k) second[k] += other.second[k];
  }
};

// Sums of the members that one plane claims alone, and of the others.
struct MemberSums {
  WideSums sole, contested;
};

MemberSums sums_of(const Cloud& cloud, const std::vector<std::uint32_t>& indices,
                   const Steps& steps, std::span<const char> contested) {
  MemberSums out;
  for (const std::uint32_t i : indices) {
    const Eigen::Vector3d scaled = (cloud.positions[i] - steps.corner) * steps.per_step;
    WideSums& sums = !contested.empty() && contested[i] ? out.contested : out.sole;
    sums.add(static_cast<std::int64_t>(scaled.x()), static_cast<std::int64_t>(scaled.y()),
             static_cast<std::int64_t>(scaled.z()));
  }
  return out;
}

// Scatter about the mean, in steps squared: the means' whole part is taken off exactly first.
Eigen::Matrix3d scatter_of(const WideSums& s) {
  const Wide count = s.count;
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

using Principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

// The sums that the plane is fitted to: of the undisputed members, where those are enough and as
// broad as all.
std::pair<WideSums, Principal> sums_to_fit(const MemberSums& members) {
  WideSums all = members.sole;
  all.add(members.contested);
  const Principal of_all(scatter_of(all));
  if (members.contested.count == 0 || members.sole.count < std::max<std::int64_t>(3, all.count / 2))
    return {all, of_all};
  const Principal of_sole(scatter_of(members.sole));
  const auto mean_square = [](const Principal& p, std::int64_t count) {
    return p.eigenvalues()[1] / static_cast<double>(count);
  };
  if (mean_square(of_sole, members.sole.count) < mean_square(of_all, all.count) / 4)
    return {all, of_all};
  return {members.sole, of_sole};
}

// Towards the scanner; where nobody said where it stood, the largest component is positive.
Plane oriented(const Plane& plane, const Cloud& cloud) {
  if (cloud.scanner_position)
    return plane.signed_distance(*cloud.scanner_position) < 0 ? plane.flipped() : plane;
  Eigen::Index largest = 0;
  plane.normal.cwiseAbs().maxCoeff(&largest);
  return plane.normal[largest] < 0 ? plane.flipped() : plane;
}

}  // namespace

PlaneRegion fit_region(const Cloud& cloud, std::vector<std::uint32_t> indices,
                       std::span<const char> contested) {
  const Steps steps = steps_of(cloud, indices);
  const auto [sums, eigen] = sums_to_fit(sums_of(cloud, indices, steps, contested));
  const auto count = static_cast<double>(sums.count);
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

bool comes_first(const PlaneRegion& a, const PlaneRegion& b) {
  if (a.indices.size() != b.indices.size()) return a.indices.size() > b.indices.size();
  return std::lexicographical_compare(a.centroid_m.begin(), a.centroid_m.end(),
                                      b.centroid_m.begin(), b.centroid_m.end());
}

std::vector<PlaneRegion> regions_from_labels(const Cloud& cloud, const PointLabels& labels,
                                             std::size_t planes, std::size_t min_points) {
  std::vector<std::size_t> counts(planes, 0);
  for (const std::int32_t p : labels.plane)
    if (p >= 0) ++counts[static_cast<std::size_t>(p)];
  std::vector<std::vector<std::uint32_t>> members(planes);
  const std::size_t least = std::max<std::size_t>(3, min_points);
  for (std::size_t p = 0; p < planes; ++p)
    if (counts[p] >= least) members[p].reserve(counts[p]);
  for (std::size_t i = 0; i < labels.plane.size(); ++i) {
    const std::int32_t p = labels.plane[i];
    if (p >= 0 && counts[static_cast<std::size_t>(p)] >= least)
      members[static_cast<std::size_t>(p)].push_back(static_cast<std::uint32_t>(i));
  }
  std::erase_if(members, [](const auto& m) { return m.empty(); });
  std::vector<PlaneRegion> regions(members.size());
  parallel_chunks(members.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      regions[p] = fit_region(cloud, std::move(members[p]), labels.contested);
  });
  std::sort(regions.begin(), regions.end(), comes_first);
  return regions;
}

}  // namespace alea
