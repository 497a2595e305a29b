#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "alea/cloud/normals.hpp"
#include "alea/cloud/sampling.hpp"
#include "alea/markerless/fpfh.hpp"
#include "alea/markerless/keypoints.hpp"
#include "experiments/markerless/twin_study.hpp"
#include "tests/markerless/pcl/pcl_oracle.hpp"

namespace alea {
namespace {

using testing::PclHarris;
using testing::PclKeypoints;

/// A station of the bell tower on a grid of 0.15 m, in coordinates that a float holds exactly.
const Cloud& scan() {
  static const Cloud cloud = [] {
    using namespace experiments::markerless;
    TwinOptions twin;
    twin.step_rad = 12e-3;
    Cloud sample = grid_average(scan_twin(bell_tower(twin), {0}, 1).clouds[0], 0.15);
    for (Eigen::Vector3d& p : sample.positions) p = p.cast<float>().cast<double>();
    sample.normals.clear();
    for (const Eigen::Vector3d& n : estimate_normals(sample, {12, Eigen::Vector3d(0, 0, 0)}))
      sample.normals.push_back(n.cast<float>());
    return sample;
  }();
  return cloud;
}

PclKeypoints by_index(const std::vector<Keypoint>& keypoints) {
  PclKeypoints out;
  for (const Keypoint& keypoint : keypoints) out[keypoint.index] = keypoint.response;
  return out;
}

/// Keypoints that both have over those that either has.
double common_share(const PclKeypoints& a, const PclKeypoints& b) {
  const auto common =
      std::count_if(a.begin(), a.end(), [&](const auto& one) { return b.contains(one.first); });
  return static_cast<double>(common) / static_cast<double>(a.size() + b.size()) /
         (1 - static_cast<double>(common) / static_cast<double>(a.size() + b.size()));
}

double largest_difference(const PclKeypoints& a, const PclKeypoints& b) {
  double largest = 0;
  for (const auto& [index, response] : a)
    if (const auto other = b.find(index); other != b.end())
      largest = std::max(largest, std::abs(response - other->second));
  return largest;
}

TEST(PclOracle, HarrisFindsTheSameKeypointsWithTheSameResponses) {
  const auto ours = by_index(harris_keypoints(scan(), {0.3, HarrisResponse::determinant, 1e-5}));
  const auto pcl = testing::pcl_harris(scan(), 0.3, PclHarris::noble, 1e-5);
  ASSERT_GT(pcl.size(), 100);
  EXPECT_GT(common_share(ours, pcl), 0.99);
  EXPECT_LT(largest_difference(ours, pcl), 1e-6);
}

TEST(PclOracle, TheLeastEigenvalueIsTomasi) {
  const auto ours = by_index(harris_keypoints(scan(), {0.3, HarrisResponse::least, 1e-3}));
  const auto pcl = testing::pcl_harris(scan(), 0.3, PclHarris::tomasi, 1e-3);
  ASSERT_GT(pcl.size(), 100);
  EXPECT_GT(common_share(ours, pcl), 0.99);
  EXPECT_LT(largest_difference(ours, pcl), 1e-5);
}

TEST(PclOracle, HarrisNobleAndLoweAreOneOnUnitNormals) {
  const auto noble = testing::pcl_harris(scan(), 0.3, PclHarris::noble, 1e-5);
  for (const PclHarris other : {PclHarris::harris, PclHarris::lowe}) {
    const auto found = testing::pcl_harris(scan(), 0.3, other, 1e-5);
    EXPECT_GT(common_share(noble, found), 0.99);
    EXPECT_LT(largest_difference(noble, found), 1e-6);
  }
}

/// One neighbour is enough: PCL asks for the least number within the suppression radius as well.
TEST(PclOracle, IssWithPlainSumsFindsTheSameKeypoints) {
  IssOptions options;
  options.least_neighbours = 1;
  options.scatter = IssScatter::plain_sum;
  const auto ours = by_index(iss_keypoints(scan(), options));
  const auto pcl = testing::pcl_iss(scan(), 0.6, 0.4, 0.975, 0.975, 1);
  ASSERT_GT(pcl.size(), 100);
  EXPECT_GT(common_share(ours, pcl), 0.99);
}

/// The published weights even out the density, which the plain sums follow: most keypoints stay.
TEST(PclOracle, IssOfThePaperFindsMostOfThem) {
  const std::vector<Keypoint> ours = iss_keypoints(scan(), {});
  const auto pcl = testing::pcl_iss(scan(), 0.6, 0.4, 0.975, 0.975, 5);
  const auto near = std::count_if(ours.begin(), ours.end(), [&](const Keypoint& keypoint) {
    return std::any_of(pcl.begin(), pcl.end(), [&](const auto& other) {
      return (scan().positions[other.first] - keypoint.position_m).norm() < 0.4;
    });
  });
  EXPECT_GT(static_cast<double>(near), 0.8 * static_cast<double>(ours.size()));
}

/// Largest difference of a bin of each point, sorted; the bins of a part sum to 100.
std::vector<double> bin_differences(const std::vector<Fpfh>& ours, const std::vector<Fpfh>& other) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    double largest = 0;
    for (std::size_t k = 0; k < ours[i].size(); ++k)
      largest = std::max(largest, static_cast<double>(std::abs(ours[i][k] - other[i][k])));
    differences.push_back(largest);
  }
  std::sort(differences.begin(), differences.end());
  return differences;
}

TEST(PclOracle, FpfhWithInverseSquaresGivesTheSameHistograms) {
  const NeighbourIndex index(scan().positions);
  const auto pcl = testing::pcl_fpfh(scan(), 0.75);
  ASSERT_EQ(pcl.size(), scan().size());
  const auto differences =
      bin_differences(fpfh(scan(), index, 0.75, FpfhWeights::inverse_square), pcl);
  EXPECT_LT(differences[differences.size() / 2], 0.01);
  EXPECT_LT(differences[differences.size() * 99 / 100], 2);
}

}  // namespace
}  // namespace alea
