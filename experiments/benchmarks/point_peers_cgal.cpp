#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/pca_estimate_normals.h>

#include <cstdint>
#include <nanoflann.hpp>
#include <vector>

#include "experiments/benchmarks/point_peers.hpp"

namespace alea::benchmarks {
namespace {

struct Points {
  std::span<const Eigen::Vector3d> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3>;

}  // namespace

struct NanoflannPeer::Data {
  Points points;
  Tree tree{3, points};
};

NanoflannPeer::NanoflannPeer(std::span<const Eigen::Vector3d> points)
    : data_(new Data{Points{points}}) {
  data_->tree.buildIndex();
}

NanoflannPeer::~NanoflannPeer() = default;

double NanoflannPeer::squared_distance_of(const Eigen::Vector3d& point, std::size_t k) const {
  std::vector<std::uint32_t> indices(k);
  std::vector<double> squares(k);
  const std::size_t found = data_->tree.knnSearch(point.data(), k, indices.data(), squares.data());
  return squares[found - 1];
}

std::size_t cgal_normals(std::span<const Eigen::Vector3d> points, unsigned neighbours) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<std::pair<Kernel::Point_3, Kernel::Vector_3>> with_normals;
  with_normals.reserve(points.size());
  for (const Eigen::Vector3d& p : points)
    with_normals.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Vector_3());
  using Pair = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  CGAL::pca_estimate_normals<CGAL::Parallel_if_available_tag>(
      with_normals, neighbours,
      CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Pair>())
          .normal_map(CGAL::Second_of_pair_property_map<Pair>()));
  return with_normals.size();
}

}  // namespace alea::benchmarks
