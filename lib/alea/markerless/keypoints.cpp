#include "alea/markerless/keypoints.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <tuple>

#include "alea/cloud/neighbours.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

using Eigenvalues = Eigen::Vector3d;  // ascending

Eigenvalues eigenvalues_of(const Eigen::Matrix3d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

double harris_response(const Cloud& cloud, const std::vector<Neighbour>& near,
                       HarrisResponse kind) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Neighbour& other : near) {
    const Eigen::Vector3d n = cloud.normals[other.index].cast<double>();
    squares += n * n.transpose();
    sum += n;
  }
  const auto count = static_cast<double>(near.size());
  squares /= count;
  switch (kind) {
    case HarrisResponse::determinant:
      return squares.determinant();
    case HarrisResponse::least:
      return eigenvalues_of(squares)[0];
    case HarrisResponse::middle:
      return eigenvalues_of(squares)[1];
    case HarrisResponse::centred:
      return squares.trace() - (sum / count).squaredNorm();
  }
  return none;
}

/// Points whose response is the largest within a radius, sorted; of equal ones the first by
/// coordinates stays.
std::vector<Keypoint> local_maxima(const Cloud& cloud, const NeighbourIndex& index,
                                   const std::vector<double>& response, double radius_m,
                                   double threshold) {
  const auto key = [&](std::uint32_t i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    return std::tuple(-response[i], p.x(), p.y(), p.z(), i);
  };
  std::vector<std::uint8_t> highest(cloud.size(), 0);
  parallel_chunks(cloud.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!(response[i] > threshold)) continue;
      const auto mine = key(static_cast<std::uint32_t>(i));
      highest[i] = 1;
      for (const Neighbour& other : index.within(cloud.positions[i], radius_m))
        if (key(other.index) < mine) {
          highest[i] = 0;
          break;
        }
    }
  });
  std::vector<Keypoint> keypoints;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (highest[i] != 0) keypoints.push_back({i, cloud.positions[i], response[i]});
  std::sort(keypoints.begin(), keypoints.end(),
            [&](const Keypoint& a, const Keypoint& b) { return key(a.index) < key(b.index); });
  return keypoints;
}

}  // namespace

std::vector<Keypoint> harris_keypoints(const Cloud& cloud, const HarrisOptions& options) {
  if (cloud.normals.size() != cloud.size())
    throw usage_error("harris: the cloud has no normals; estimate them first");
  const NeighbourIndex index(cloud.positions);
  std::vector<double> response(cloud.size(), none);
  parallel_chunks(cloud.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      response[i] = harris_response(cloud, index.within(cloud.positions[i], options.radius_m),
                                    options.response);
  });
  return local_maxima(cloud, index, response, options.radius_m, options.threshold);
}

std::vector<Keypoint> iss_keypoints(const Cloud& cloud, const IssOptions& options) {
  const NeighbourIndex index(cloud.positions);
  // Only how many: the lists of a dense scan would fill the memory.
  std::vector<std::size_t> count(cloud.size());
  parallel_chunks(cloud.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      count[i] = index.within(cloud.positions[i], options.salient_radius_m).size();
  });
  const bool is_plain = options.scatter == IssScatter::plain_sum;
  std::vector<double> response(cloud.size(), none);
  parallel_chunks(cloud.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (count[i] < options.least_neighbours) continue;
      Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
      double weights = 0;
      for (const Neighbour& other : index.within(cloud.positions[i], options.salient_radius_m)) {
        const Eigen::Vector3d d = cloud.positions[other.index] - cloud.positions[i];
        const double weight = is_plain ? 1 : 1 / static_cast<double>(count[other.index]);
        scatter += weight * d * d.transpose();
        weights += weight;
      }
      const Eigenvalues values = eigenvalues_of(is_plain ? scatter : scatter / weights);
      if (values[1] < options.largest_ratio_21 * values[2] &&
          values[0] < options.largest_ratio_32 * values[1] && values[0] > 0)
        response[i] = values[0];
    }
  });
  return local_maxima(cloud, index, response, options.suppression_radius_m, 0);
}

}  // namespace alea
