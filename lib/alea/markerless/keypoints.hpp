#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

struct Keypoint {
  std::uint32_t index = 0;  ///< of the point in the cloud
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double response = 0;
};

/// What is large at a corner. C is the mean of n n' over the unit normals of the neighbours: its
/// trace is 1, so that det(C), det(C) / tr(C) and det(C) / tr(C)^2 (the variants of the Point Cloud
/// Library, its HARRIS up to a constant) rank the points in one and the same way and count as one.
enum class HarrisResponse {
  determinant,  ///< det(C): three directions of normals, Harris's corner
  least,        ///< least eigenvalue of C: the weakest of the three (Shi, Tomasi 1994)
  middle,       ///< middle eigenvalue of C: edges count as well
  centred       ///< trace of the covariance of the normals about their mean: any bend
};

struct HarrisOptions {
  double radius_m = 0.3;  ///< of the neighbours, and within which only the largest response stays
  HarrisResponse response = HarrisResponse::determinant;
  double threshold = 1e-3;
};

/// Harris 3D on normals: Sipiran, Bustos 2011, doi 10.1007/s00371-011-0610-y, as in the Point Cloud
/// Library. The cloud needs unit normals. Sorted by falling response, then by coordinates; the same
/// for any thread count and order of the points. Throws Error(usage) without normals.
std::vector<Keypoint> harris_keypoints(const Cloud& cloud, const HarrisOptions& options);

/// How the scatter about a point weighs its neighbours.
enum class IssScatter {
  even_density,  ///< by the inverse of their own number of neighbours, over the sum of the weights
  plain_sum      ///< all alike and not divided, as in the Point Cloud Library: dense places win
};

struct IssOptions {
  double salient_radius_m = 0.6;
  double suppression_radius_m = 0.4;
  double largest_ratio_21 = 0.975;  ///< of the second eigenvalue to the first
  double largest_ratio_32 = 0.975;  ///< of the third to the second
  std::size_t least_neighbours = 5;
  IssScatter scatter = IssScatter::even_density;
};

/// Intrinsic shape signatures: Zhong 2009, doi 10.1109/ICCVW.2009.5457637. The response is the
/// third eigenvalue of the scatter about the point (m^2). Sorted as above.
std::vector<Keypoint> iss_keypoints(const Cloud& cloud, const IssOptions& options);

}  // namespace alea
