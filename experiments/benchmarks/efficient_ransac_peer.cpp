#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <tuple>

#include "alea/cgal/kernels.hpp"
#include "experiments/benchmarks/plane_peers.hpp"

namespace alea::benchmarks {
namespace {

using Sample = std::tuple<Data::Point_3, Data::Vector_3, std::uint32_t>;
using PointMap = CGAL::Nth_of_tuple_property_map<0, Sample>;
using NormalMap = CGAL::Nth_of_tuple_property_map<1, Sample>;
using Traits =
    CGAL::Shape_detection::Efficient_RANSAC_traits<Data, std::vector<Sample>, PointMap, NormalMap>;

}  // namespace

struct EfficientRansacPeer::State {
  std::vector<Sample> samples;
  std::vector<Sample> copy;
};

EfficientRansacPeer::EfficientRansacPeer(const std::vector<Eigen::Vector3d>& positions)
    : state_(std::make_unique<State>()) {
  std::uint32_t index = 0;
  for (const Eigen::Vector3d& p : positions)
    state_->samples.emplace_back(Data::Point_3(p.x(), p.y(), p.z()), Data::Vector_3(0, 0, 0),
                                 index++);
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
      state_->samples, 16, CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
}

EfficientRansacPeer::~EfficientRansacPeer() = default;

void EfficientRansacPeer::prepare() {
  state_->copy = state_->samples;
}

PointSets EfficientRansacPeer::detect(const PeerOptions& options) {
  CGAL::Shape_detection::Efficient_RANSAC<Traits> ransac;
  ransac.set_input(state_->copy);
  ransac.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
  CGAL::Shape_detection::Efficient_RANSAC<Traits>::Parameters parameters;
  parameters.probability = options.probability;
  parameters.min_points = options.min_points;
  parameters.epsilon = options.epsilon_m;
  parameters.cluster_epsilon = options.cluster_epsilon_m;
  parameters.normal_threshold = options.normal_threshold;
  CGAL::get_default_random() = CGAL::Random(42);
  ransac.detect(parameters);
  PointSets sets;
  for (const auto& shape : ransac.shapes()) {
    sets.emplace_back();
    for (const std::size_t i : shape->indices_of_assigned_points())
      sets.back().push_back(std::get<2>(state_->copy[i]));
  }
  return sets;
}

}  // namespace alea::benchmarks
