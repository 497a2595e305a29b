#include "tests/markerless/pcl/pcl_oracle.hpp"

#include <pcl/features/fpfh.h>
#include <pcl/keypoints/harris_3d.h>
#include <pcl/keypoints/iss_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>

namespace alea::testing {
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Harris = pcl::HarrisKeypoint3D<pcl::PointXYZ, pcl::PointXYZI, pcl::Normal>;

Points::Ptr points_of(const Cloud& cloud) {
  Points::Ptr points(new Points);
  for (const Eigen::Vector3d& p : cloud.positions) {
    const Eigen::Vector3f q = p.cast<float>();
    points->emplace_back(q.x(), q.y(), q.z());
  }
  return points;
}

Normals::Ptr normals_of(const Cloud& cloud) {
  Normals::Ptr normals(new Normals);
  for (const Eigen::Vector3f& n : cloud.normals) normals->emplace_back(n.x(), n.y(), n.z());
  return normals;
}

template <typename Detector>
PclKeypoints detected(Detector& detector,
                      double (*response)(const typename Detector::PointCloudOut::PointType&)) {
  typename Detector::PointCloudOut found;
  detector.compute(found);
  PclKeypoints keypoints;
  const auto indices = detector.getKeypointsIndices();
  for (std::size_t i = 0; i < found.size(); ++i)
    keypoints[static_cast<std::uint32_t>(indices->indices[i])] = response(found[i]);
  return keypoints;
}

Harris::ResponseMethod method_of(PclHarris response) {
  switch (response) {
    case PclHarris::harris:
      return Harris::HARRIS;
    case PclHarris::noble:
      return Harris::NOBLE;
    case PclHarris::lowe:
      return Harris::LOWE;
    case PclHarris::tomasi:
      break;
  }
  return Harris::TOMASI;
}

}  // namespace

PclKeypoints pcl_harris(const Cloud& cloud, double radius_m, PclHarris response, double threshold) {
  Harris detector(method_of(response), static_cast<float>(radius_m), static_cast<float>(threshold));
  detector.setRadius(static_cast<float>(radius_m));
  detector.setNonMaxSupression(true);
  detector.setRefine(false);
  detector.setNumberOfThreads(1);
  detector.setInputCloud(points_of(cloud));
  detector.setNormals(normals_of(cloud));
  detector.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  return detected(
      detector, +[](const pcl::PointXYZI& p) { return static_cast<double>(p.intensity); });
}

PclKeypoints pcl_iss(const Cloud& cloud, double salient_radius_m, double suppression_radius_m,
                     double largest_ratio_21, double largest_ratio_32, int least_neighbours) {
  pcl::ISSKeypoint3D<pcl::PointXYZ, pcl::PointXYZ> detector;
  detector.setSalientRadius(salient_radius_m);
  detector.setNonMaxRadius(suppression_radius_m);
  detector.setThreshold21(largest_ratio_21);
  detector.setThreshold32(largest_ratio_32);
  detector.setMinNeighbors(least_neighbours);
  detector.setNumberOfThreads(1);
  detector.setInputCloud(points_of(cloud));
  detector.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  return detected(
      detector, +[](const pcl::PointXYZ&) { return 0.0; });
}

std::vector<std::array<float, 33>> pcl_fpfh(const Cloud& cloud, double radius_m) {
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(points_of(cloud));
  estimation.setInputNormals(normals_of(cloud));
  estimation.setRadiusSearch(radius_m);
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  pcl::PointCloud<pcl::FPFHSignature33> found;
  estimation.compute(found);
  std::vector<std::array<float, 33>> features(found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    std::copy_n(found[i].histogram, 33, features[i].begin());
  return features;
}

}  // namespace alea::testing
