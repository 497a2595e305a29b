#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea::testing {

/// What the Point Cloud Library (1.13) makes of a cloud, in single precision. Keypoints are
/// responses by the index of their point.
using PclKeypoints = std::map<std::uint32_t, double>;

/// Its names for responses of HarrisKeypoint3D.
enum class PclHarris { harris, noble, lowe, tomasi };

/// HarrisKeypoint3D on the cloud's own normals, without its refinement.
PclKeypoints pcl_harris(const Cloud& cloud, double radius_m, PclHarris response, double threshold);

/// ISSKeypoint3D without its test for borders. PCL gives no responses here: they are all 0.
PclKeypoints pcl_iss(const Cloud& cloud, double salient_radius_m, double suppression_radius_m,
                     double largest_ratio_21, double largest_ratio_32, int least_neighbours);

/// FPFHEstimation on the cloud's own normals.
std::vector<std::array<float, 33>> pcl_fpfh(const Cloud& cloud, double radius_m);

}  // namespace alea::testing
