#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace alea::benchmarks {

using PointSets = std::vector<std::vector<std::uint32_t>>;

struct PeerOptions {
  double epsilon_m = 0.006;
  double cluster_epsilon_m = 0.1;
  std::size_t min_points = 500;
  double probability = 0.01;
  double normal_threshold = 0.9;
};

/// CGAL's Efficient RANSAC, seeded with 42, on points that have their normals already: the returned
/// function is what is timed; the copy that it needs is made before.
class EfficientRansacPeer {
 public:
  explicit EfficientRansacPeer(const std::vector<Eigen::Vector3d>& positions);
  ~EfficientRansacPeer();
  /// Makes the private copy that the detection reorders.
  void prepare();
  PointSets detect(const PeerOptions& options);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// PCL's SACSegmentation, iterated: the largest plane is taken out until none has min_points.
class PclPlanesPeer {
 public:
  explicit PclPlanesPeer(const std::vector<Eigen::Vector3d>& positions);
  ~PclPlanesPeer();
  PointSets detect(const PeerOptions& options) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace alea::benchmarks
