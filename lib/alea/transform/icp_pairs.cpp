#include "alea/transform/icp_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

void pair_point(const IcpTarget::Data& target, double limit_m2, std::size_t i, IcpPairs& pairs) {
  double bound = limit_m2;
  const std::uint32_t before = pairs.target[i];
  if (before != IcpPairs::none) {
    const double squared = (target.points.positions[before] - pairs.moved[i]).squaredNorm();
    if (squared < bound)
      bound = squared;
    else
      pairs.target[i] = IcpPairs::none;
  }
  if (const auto nearest = target.index->nearest_one(pairs.moved[i], std::sqrt(bound))) {
    pairs.target[i] = nearest->index;
    bound = nearest->squared_distance_m2;
  }
  pairs.used[i] = pairs.target[i] != IcpPairs::none;
  pairs.squared_m2[i] = bound;
}

void drop_disagreeing_normals(const IcpTarget::Data& target, const IcpPoints& source,
                              const Eigen::Matrix3d& rotation, const IcpOptions& options,
                              IcpPairs& pairs) {
  const double least_cosine = std::cos(options.normal_angle_rad);
  parallel_chunks(pairs.used.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!pairs.used[i]) continue;
      const double cosine =
          target.points.normals[pairs.target[i]].dot(rotation * source.normals[i]);
      pairs.used[i] = (options.oriented_normals ? cosine : std::abs(cosine)) >= least_cosine;
    }
  });
}

void trim(double share, IcpPairs& pairs) {
  std::vector<double> distances;
  distances.reserve(pairs.used.size());
  for (std::size_t i = 0; i < pairs.used.size(); ++i)
    if (pairs.used[i]) distances.push_back(pairs.squared_m2[i]);
  if (distances.empty()) return;
  const auto kept =
      static_cast<std::size_t>(std::ceil((1 - share) * static_cast<double>(distances.size())));
  const auto last =
      distances.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(kept, 1) - 1);
  std::nth_element(distances.begin(), last, distances.end());
  for (std::size_t i = 0; i < pairs.used.size(); ++i)
    if (pairs.squared_m2[i] > *last) pairs.used[i] = 0;
}

}  // namespace

void update_pairs(const IcpTarget::Data& target, const IcpPoints& source,
                  const RigidTransform& target_from_source, const IcpOptions& options,
                  IcpPairs& pairs) {
  const std::size_t count = source.positions.size();
  pairs.moved.resize(count);
  pairs.target.resize(count, IcpPairs::none);
  pairs.squared_m2.resize(count);
  pairs.used.resize(count);
  const double limit_m2 = options.max_distance_m * options.max_distance_m;
  parallel_chunks(count, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      pairs.moved[i] = target_from_source * source.positions[i];
      pair_point(target, limit_m2, i, pairs);
    }
  });
  if (options.normal_angle_rad < std::numbers::pi / 2)
    drop_disagreeing_normals(target, source, target_from_source.rotation, options, pairs);
  if (options.trim_share > 0) trim(options.trim_share, pairs);
  pairs.count = static_cast<std::size_t>(std::count(pairs.used.begin(), pairs.used.end(), 1));
}

}  // namespace alea
