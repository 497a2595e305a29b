#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

#include "experiments/benchmarks/point_peers.hpp"

namespace alea::benchmarks {

struct PclGridPeer::Data {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
};

PclGridPeer::PclGridPeer(std::span<const Eigen::Vector3d> points)
    : data_(std::make_unique<Data>()) {
  for (const Eigen::Vector3d& p : points)
    data_->cloud->push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
}

PclGridPeer::~PclGridPeer() = default;

std::size_t PclGridPeer::size_of(double cell_m) const {
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(data_->cloud);
  const auto cell = static_cast<float>(cell_m);
  grid.setLeafSize(cell, cell, cell);
  pcl::PointCloud<pcl::PointXYZ> out;
  grid.filter(out);
  return out.size();
}

struct PclIcpPeer::Data {
  pcl::PointCloud<pcl::PointNormal>::Ptr target{new pcl::PointCloud<pcl::PointNormal>};
  pcl::PointCloud<pcl::PointNormal>::Ptr source{new pcl::PointCloud<pcl::PointNormal>};
};

PclIcpPeer::PclIcpPeer(const Cloud& target, const Cloud& source) : data_(std::make_unique<Data>()) {
  for (std::size_t i = 0; i < target.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = target.positions[i].cast<float>();
    point.getNormalVector3fMap() = target.normals[i];
    data_->target->push_back(point);
  }
  for (const Eigen::Vector3d& p : source.positions) {
    pcl::PointNormal point;
    point.getVector3fMap() = p.cast<float>();
    data_->source->push_back(point);
  }
}

PclIcpPeer::~PclIcpPeer() = default;

RigidTransform PclIcpPeer::align(const RigidTransform& start, double max_distance_m,
                                 int iterations) const {
  pcl::IterativeClosestPoint<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setTransformationEstimation(
      std::make_shared<pcl::registration::TransformationEstimationPointToPlaneLLS<
          pcl::PointNormal, pcl::PointNormal>>());
  icp.setInputTarget(data_->target);
  icp.setInputSource(data_->source);
  icp.setMaxCorrespondenceDistance(max_distance_m);
  icp.setMaximumIterations(iterations);
  icp.setTransformationEpsilon(1e-12);
  pcl::PointCloud<pcl::PointNormal> aligned;
  icp.align(aligned, start.matrix().cast<float>());
  const Eigen::Matrix4d found = icp.getFinalTransformation().cast<double>();
  return {found.topLeftCorner<3, 3>(), found.topRightCorner<3, 1>()};
}

}  // namespace alea::benchmarks
