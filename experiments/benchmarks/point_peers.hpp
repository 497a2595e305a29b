#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"

namespace alea::benchmarks {

// Other libraries behind plain functions: their headers stay in their own sources. What converts
// the points runs in the constructors, off the clock.

/// pcl::VoxelGrid.
class PclGridPeer {
 public:
  explicit PclGridPeer(std::span<const Eigen::Vector3d> points);
  ~PclGridPeer();
  std::size_t size_of(double cell_m) const;  ///< points of the grid

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// pcl::IterativeClosestPoint with TransformationEstimationPointToPlaneLLS.
class PclIcpPeer {
 public:
  PclIcpPeer(const Cloud& target_with_normals, const Cloud& source);
  ~PclIcpPeer();
  RigidTransform align(const RigidTransform& start, double max_distance_m, int iterations) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// nanoflann::KDTreeSingleIndexAdaptor over three doubles a point.
class NanoflannPeer {
 public:
  explicit NanoflannPeer(std::span<const Eigen::Vector3d> points);
  ~NanoflannPeer();
  /// Of the k-th neighbour.
  double squared_distance_of(const Eigen::Vector3d& point, std::size_t k) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// CGAL::pca_estimate_normals, in parallel; returns how many there are.
std::size_t cgal_normals(std::span<const Eigen::Vector3d> points, unsigned neighbours);

}  // namespace alea::benchmarks
