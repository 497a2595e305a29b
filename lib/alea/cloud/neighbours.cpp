#include "alea/cloud/neighbours.hpp"

#include <algorithm>
#include <nanoflann.hpp>

namespace alea {
namespace {

struct Adaptor {
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

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Adaptor>,
                                                   Adaptor, 3, std::uint32_t>;

void sort_neighbours(std::vector<Neighbour>& found) {
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.squared_distance_m2 != b.squared_distance_m2
               ? a.squared_distance_m2 < b.squared_distance_m2
               : a.index < b.index;
  });
}

}  // namespace

struct NeighbourIndex::Tree {
  explicit Tree(std::span<const Eigen::Vector3d> points)
      : adaptor{points}, index(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    index.buildIndex();
  }
  Adaptor adaptor;
  KdTree index;
};

NeighbourIndex::NeighbourIndex(std::span<const Eigen::Vector3d> points)
    : tree_(std::make_unique<Tree>(points)) {}
NeighbourIndex::~NeighbourIndex() = default;
NeighbourIndex::NeighbourIndex(NeighbourIndex&&) noexcept = default;
NeighbourIndex& NeighbourIndex::operator=(NeighbourIndex&&) noexcept = default;

std::vector<Neighbour> NeighbourIndex::nearest(const Eigen::Vector3d& point, std::size_t k) const {
  std::vector<std::uint32_t> indices(k);
  std::vector<double> distances(k);
  const std::size_t count =
      tree_->index.knnSearch(point.data(), k, indices.data(), distances.data());
  std::vector<Neighbour> found(count);
  for (std::size_t i = 0; i < count; ++i) found[i] = {indices[i], distances[i]};
  sort_neighbours(found);
  return found;
}

std::vector<Neighbour> NeighbourIndex::within(const Eigen::Vector3d& point,
                                              double distance_m) const {
  std::vector<std::pair<std::uint32_t, double>> matches;
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;
  tree_->index.radiusSearch(point.data(), distance_m * distance_m, matches, unsorted);
  std::vector<Neighbour> found;
  found.reserve(matches.size());
  for (const auto& [index, distance] : matches) found.push_back({index, distance});
  sort_neighbours(found);
  return found;
}

}  // namespace alea
