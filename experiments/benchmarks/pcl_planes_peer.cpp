#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include "experiments/benchmarks/plane_peers.hpp"

namespace alea::benchmarks {

struct PclPlanesPeer::State {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
};

PclPlanesPeer::PclPlanesPeer(const std::vector<Eigen::Vector3d>& positions)
    : state_(std::make_unique<State>()) {
  for (const Eigen::Vector3d& p : positions)
    state_->cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                static_cast<float>(p.z()));
}

PclPlanesPeer::~PclPlanesPeer() = default;

PointSets PclPlanesPeer::detect(const PeerOptions& options) const {
  PointSets sets;
  pcl::IndicesPtr rest(new pcl::Indices(state_->cloud->size()));
  for (std::size_t i = 0; i < rest->size(); ++i) (*rest)[i] = static_cast<pcl::index_t>(i);
  std::vector<bool> taken(state_->cloud->size(), false);
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(options.epsilon_m);
  segmentation.setMaxIterations(1000);
  segmentation.setProbability(1 - options.probability);
  segmentation.setInputCloud(state_->cloud);
  while (rest->size() >= options.min_points) {
    segmentation.setIndices(rest);
    pcl::PointIndices inliers;
    pcl::ModelCoefficients coefficients;
    segmentation.segment(inliers, coefficients);
    if (inliers.indices.size() < options.min_points) break;
    sets.emplace_back(inliers.indices.begin(), inliers.indices.end());
    for (const pcl::index_t i : inliers.indices) taken[static_cast<std::size_t>(i)] = true;
    std::erase_if(*rest, [&](pcl::index_t i) { return taken[static_cast<std::size_t>(i)]; });
  }
  return sets;
}

}  // namespace alea::benchmarks
